"""Floor, light and background, for light and dark pages."""

from __future__ import annotations

import viser

Colour = tuple[int, int, int]

#: Dark page or not -> plane, cells, sections.
_FLOORS: dict[bool, tuple[Colour, Colour, Colour]] = {
    False: ((238, 240, 243), (220, 224, 229), (198, 204, 211)),
    True: ((38, 41, 46), (54, 58, 64), (74, 79, 87)),
}


FLOOR = "/floor"  # name of its node


def floor_colours(*, dark: bool) -> dict[str, Colour]:
    """Colours of the floor on a dark or a light page, by viser's names."""
    return dict(zip(("plane_color", "cell_color", "section_color"), _FLOORS[dark], strict=True))


def light_up(scene: viser.SceneApi) -> None:
    """Lights without shadows: a page without a graphics card stays smooth."""
    scene.configure_default_lights(cast_shadow=False)
    scene.configure_environment_map(hdri=None)
    scene.add_light_ambient("/lights/ambient", intensity=0.9)


def lay_floor(scene: viser.SceneApi, *, dark: bool) -> None:
    """A square floor with a quarter-metre grid."""
    colours = floor_colours(dark=dark)
    scene.add_grid(
        FLOOR,
        width=6.0,
        height=6.0,
        cell_size=0.25,
        section_size=1.0,
        plane_opacity=1.0,
        position=(0.0, 0.0, -0.002),
        shadow_opacity=0.0,
        fade_distance=12.0,
        fade_strength=2.0,
        plane_color=colours["plane_color"],
        cell_color=colours["cell_color"],
        section_color=colours["section_color"],
    )
