"""An arm as somebody brings it: a zip of a ROS package, a description and a mesh."""

import zipfile

import trimesh

from app import resources

#: What the package is called on the pendant.
TITLE = "bent"
MESH = "package://bent_description/meshes/part.stl"
OUTSIDE = "../../../../../etc/passwd"


def text(mesh=MESH):
    """A UR10e under another name, one part of it a mesh; its angles and lengths are those of the shipped one."""
    shipped = (resources.ROBOTS / "ur10e" / "robot.urdf").read_text(encoding="utf-8")
    visual = f'<visual><origin xyz="0 0 0.05"/><geometry><mesh filename="{mesh}"/></geometry></visual>'
    return shipped.replace('<link name="base">', f'<link name="base">{visual}')


def zipped(folder, description=None, extra=()):
    """The zip's path; `extra` are further names in it."""
    trimesh.creation.icosphere(radius=0.05).export(folder / "part.stl")
    path = folder / "bent_description.zip"
    with zipfile.ZipFile(path, "w") as out:
        out.writestr("bent_description/package.xml", "<package/>")
        out.writestr(f"bent_description/urdf/{TITLE}.urdf", description or text())
        out.write(folder / "part.stl", "bent_description/meshes/part.stl")
        for name in extra:
            out.writestr(name, "x")
    return path
