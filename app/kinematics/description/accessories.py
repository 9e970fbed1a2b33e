"""Names by which makers call what is no part of an arm: one place, used by every default rule.

Only whole words count: `head_pan` is a head, `overhead` is none. Words are parted by `_`, `-`, `/`, blanks, digits and
changes of case.
"""

from __future__ import annotations

import re

_WORDS = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+")

#: Moving parts of grippers and hands.
FINGER = frozenset(
    (
        "jaw",
        "jaws",
        "finger",
        "fingers",
        "knuckle",
        "knuckles",
        "thumb",
        "claw",
        "pincer",
        "fingertip",
        "mover",
        "ff",
        "mf",
        "rf",
        "lf",
        "th",
    )
)
#: Grippers as a whole: a link of that name may be the body that an arm's last joint carries.
GRIPPER = frozenset(
    (
        "grip",
        "gripper",
        "robotiq",
        "clamp",
    )
)
#: What is looked at or looks, and what the whole robot drives on.
ASIDE = frozenset(
    (
        "head",
        "neck",
        "screen",
        "display",
        "camera",
        "cam",
        "cameras",
        "lens",
        "optical",
        "rgb",
        "depth",
        "infra",
        "imu",
        "lidar",
        "laser",
        "sonar",
        "sensor",
        "wheel",
        "wheels",
        "caster",
        "castor",
        "pan",
        "tilt",
        "drive",
        "antenna",
        "monitor",
        "realsense",
    )
)
#: Links that stand for a solid of another link.
STUB = frozenset(
    (
        "collision",
        "sc",
        "inertia",
        "inertial",
        "visual",
        "dummy",
        "com",
        "cog",
        "mass",
        "mesh",
        "geom",
        "cover",
        "cable",
    )
)


def words(name: str) -> list[str]:
    """A name's words in small letters: `panda_link7_sc` -> panda, link, sc."""
    return [word.lower() for word in _WORDS.findall(name)]


def is_finger(name: str) -> bool:
    """True for the moving parts of grippers and hands."""
    return any(word in FINGER for word in words(name))


def is_gripper(name: str) -> bool:
    """True for grippers and their parts."""
    return any(word in FINGER or word in GRIPPER for word in words(name))


def is_aside(name: str) -> bool:
    """True for heads, cameras, screens, sensors and wheels."""
    return any(word in ASIDE for word in words(name))


def is_stub(name: str) -> bool:
    """True for links that only carry another link's solid or mass."""
    return any(word in STUB for word in words(name))
