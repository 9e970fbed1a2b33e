"""Meshes of a person's own description: found within its folder, read by trimesh, made light for a browser.

A mesh is named as `package://NAME/path`, `file:///path`, or relative to the description. Whatever the name, only files
of the description's own folder are opened: of a ROS package all packages beside it, else the folder the file is in, or
the one above where that one is called urdf, robots, description or xacro.
"""

from __future__ import annotations

import contextlib
import json
import logging
import re
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from app.geometry.pose import Pose
from app.kinematics.description.xacro import readable

KINDS = frozenset({".stl", ".dae", ".obj", ".ply", ".glb", ".gltf", ".off"})
_LARGEST = 60_000_000  # bytes of one file; makers' own meshes have up to 20 MB
_MOST_TRIANGLES = (
    6_000  # of one mesh as drawn: an arm of eight stays under 50,000, which a notebook turns smoothly
)
_MOST_VERTICES = 3_000_000  # of one file as read
_FARTHEST = 1e4  # m
_MOST_FILES = 20_000  # looked through for a name whose folders differ
_INNER = frozenset({"urdf", "robots", "robot", "description", "xacro"})
_SCHEME = re.compile(r"^([a-z]+)://+", re.IGNORECASE)


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles to draw, and the hull that can be hit.

    Args:
        vertices: (v, 3) [m].
        triangles: (t, 3) indices, wound outwards.
        hull: (h, 3) [m] corners of the convex hull.
        colour: red, green, blue, each 0..1, where the file states one.
    """

    vertices: np.ndarray
    triangles: np.ndarray
    hull: np.ndarray
    colour: tuple[float, float, float] | None = None

    def placed(self, pose: Pose) -> Mesh:
        """The same in the frame that `pose` leads to."""
        return Mesh(pose.apply(self.vertices), self.triangles, pose.apply(self.hull), self.colour)

    def scaled(self, factors: np.ndarray) -> Mesh:
        """Stretched along the axes (3,); a mirror image turns its triangles over."""
        mirrored = float(np.prod(factors)) < 0
        triangles = self.triangles[:, ::-1] if mirrored else self.triangles
        return Mesh(self.vertices * factors, triangles, self.hull * factors, self.colour)


class MeshFolder:
    """Where a description's meshes are.

    Args:
        description: the URDF's path.
    """

    def __init__(self, description: Path):
        self._file = description.resolve()
        root = readable(self._file)
        if root == self._file.parent and root.name.lower() in _INNER:
            root = root.parent
        self.root = root
        self._missing: dict[str, str] = {}

    @property
    def missing(self) -> tuple[str, ...]:
        """One line for every mesh that was asked for and is not drawn."""
        return tuple(f"{name}: {why}" for name, why in self._missing.items())

    def load(self, name: str, link: str, scale: np.ndarray) -> Mesh | None:
        """The mesh of that name, (3,) times as large; None, and a line in `missing`, where there is none."""
        path = self.find(name)
        if path is None:
            self._missing[name[:200] or f"link {link}"] = f"not in {self.root.name}/"
            return None
        try:
            status = path.stat()
            mesh = _read(str(path), status.st_mtime_ns, status.st_size).scaled(scale)
        except MeshTrouble as trouble:
            self._missing[name[:200]] = str(trouble)
            return None
        if not np.abs(mesh.vertices).max() < _FARTHEST or np.ptp(mesh.hull, axis=0).max() < 1e-6:
            self._missing[name[:200]] = "its size cannot be"
            return None
        return mesh

    def find(self, name: str) -> Path | None:
        """The file a mesh's name means, within the folder."""
        scheme = _SCHEME.match(name)
        rest = name[scheme.end() :] if scheme else name
        parts = [part for part in rest.replace("\\", "/").split("/") if part not in ("", ".")]
        if not parts or len(name) > 1000 or Path(parts[-1]).suffix.lower() not in KINDS:
            return None
        kind = scheme.group(1).lower() if scheme else "file"
        if kind not in ("package", "model", "file"):
            return None
        package = kind != "file"
        candidates = [self._file.parent.joinpath(*parts)]
        if package:
            candidates = [self.root.joinpath(*parts), self.root.joinpath(*parts[1:])]
            candidates += [
                self._file.parent.joinpath(*parts[1:]),
                self._file.parent.parent.joinpath(*parts[1:]),
            ]
        for path in candidates:
            if self._within(path):
                return path.resolve()
        return None if ".." in parts and not package else self._by_ending(parts)

    def _within(self, path: Path) -> bool:
        try:
            return path.resolve().is_relative_to(self.root) and path.is_file()
        except (OSError, ValueError):
            return False

    def _by_ending(self, parts: list[str]) -> Path | None:
        """The one file of the folder whose path ends most like the name: folders are renamed when they are copied."""
        best, length = None, 0
        for count, path in enumerate(self.root.rglob(f"*{Path(parts[-1]).suffix}")):
            if count > _MOST_FILES:
                break
            if path.name != parts[-1] or not self._within(path):
                continue
            pairs = zip(reversed(path.parts), reversed(parts), strict=False)
            same = next((k for k, (a, b) in enumerate(pairs) if a != b), len(parts))
            if same > length:
                best, length = path.resolve(), same
        return best


class MeshTrouble(Exception):
    """Why a mesh cannot be drawn, in a few words."""


@lru_cache(maxsize=256)
def _read(path: str, _mtime: int, size: int) -> Mesh:
    """One file as one light mesh in metres."""
    import trimesh  # loads slowly, and few descriptions have meshes

    if size > _LARGEST:
        raise MeshTrouble(f"{size / 1e6:.0f} MB, at most {_LARGEST / 1e6:.0f}")
    if Path(path).suffix.lower() in (".glb", ".gltf"):
        _check_counts(path)
    try:
        with _quiet():
            scene: Any = trimesh.load_scene(path)
            mesh: Any = scene.to_mesh()
        vertices, triangles = np.asarray(mesh.vertices, float), np.asarray(mesh.faces, int)
    except Exception as error:  # whatever the readers of a dozen formats raise
        raise MeshTrouble(f"cannot be read ({type(error).__name__})") from None
    if not 3 < len(vertices) <= _MOST_VERTICES or not len(triangles) or not np.isfinite(vertices).all():
        raise MeshTrouble(f"{len(vertices)} corners and {len(triangles)} triangles")
    colour = _main_colour(mesh)
    if len(triangles) > _MOST_TRIANGLES:
        mesh = _lighter(mesh)
        vertices, triangles = np.asarray(mesh.vertices, float), np.asarray(mesh.faces, int)
    return Mesh(vertices, triangles, _hull(vertices), colour)


def _check_counts(path: str) -> None:
    """Raises MeshTrouble where a glTF file says that it holds more numbers than it has room for: a count alone is as
    many zeros."""
    try:
        data = Path(path).read_bytes()
        if data.startswith(b"glTF"):
            data = data[20 : 20 + int.from_bytes(data[12:16], "little")]
        counts = [accessor.get("count", 0) for accessor in json.loads(data).get("accessors", ())]
        fits = sum(counts) <= 3 * _MOST_VERTICES and min(counts, default=0) >= 0
    except (OSError, ValueError, TypeError, AttributeError, RecursionError):
        raise MeshTrouble("cannot be read (its head)") from None
    if not fits:
        raise MeshTrouble(f"says it holds {sum(counts)} numbers")


@contextlib.contextmanager
def _quiet() -> Iterator[None]:
    """What the readers warn of is for developers, and not for the terminal."""
    logging.getLogger("trimesh").setLevel(logging.CRITICAL + 1)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


def _lighter(mesh: Any) -> Any:
    """Edges collapsed by quadric error until few enough triangles are left (Garland and Heckbert 1997)."""
    try:
        mesh.merge_vertices(merge_tex=True, merge_norm=True)
        return mesh.simplify_quadric_decimation(face_count=_MOST_TRIANGLES)
    except Exception as error:
        raise MeshTrouble(f"cannot be made light ({type(error).__name__})") from None


def _hull(vertices: np.ndarray) -> np.ndarray:
    """Corners of the convex hull; of something flat its own corners."""
    from scipy.spatial import ConvexHull, QhullError

    try:
        return vertices[ConvexHull(vertices).vertices]
    except QhullError:
        raise MeshTrouble("is flat") from None


def _main_colour(mesh: Any) -> tuple[float, float, float] | None:
    """The colour most of the surface has, where the file states one."""
    try:
        if not mesh.visual.defined:
            return None
        red, green, blue, _ = np.asarray(mesh.visual.to_color().main_color, float) / 255.0
    except Exception:  # textures without pictures, materials without colours
        return None
    return float(red), float(green), float(blue)
