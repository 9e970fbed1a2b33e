"""Which link tools are bolted to, where nobody says: rules in order.

Looked at are the link that the arm's last joint carries, and all that is fixed to it (what moves behind is a gripper).
1. Links called collision, inertia, dummy and the like, cameras, heads, sensors and fingers are never taken.
2. By name, first that fits: `tool0`; `flange`; `ee_link`, `eef`, `end_effector`; with or without a prefix or a suffix
   (`left_tool0`, `hand_flange`); then `tcp`, `tool`, `tool_frame`, `gripper_frame`.
3. A link that a gripper's moving jaws stand on.
4. Else the end of the longest line of fixed links; of equally long ones the first that stands off from the link
   before it, then the first in the file.
"""

from __future__ import annotations

import re

from app.kinematics.description.accessories import is_aside, is_finger, is_stub
from app.kinematics.description.tree import LinkTree

#: Best first.
NAMES = tuple(
    re.compile(rf"(?:.*[_\-/])?(?:{pattern})(?:[_\-/](?:link|frame))?\Z", re.IGNORECASE)
    for pattern in (
        r"tool0",
        r"flange",
        r"ee|eef|end_?effector",
        r"tcp|tool|gripper_?frame|grasp",
    )
)


def default_flange(tree: LinkTree, last: str) -> str:
    """The link that tools are bolted to on the arm whose last joint carries link `last`."""
    depths = fixed_below(tree, last)
    usable = [
        name for name in depths if name == last or not (is_stub(name) or is_aside(name) or is_finger(name))
    ]
    behind = [name for name in usable if not any(_barred(tree, name, last))]
    for pattern in NAMES:
        found = [name for name in behind if pattern.match(name)]
        if found:
            return min(found, key=lambda name: (len(name), depths[name]))
    gripped = [name for name in behind if any(joint.moves for joint in tree.below.get(name, []))]
    if gripped:
        return max(gripped, key=lambda name: depths[name])
    deepest = max(depths[name] for name in behind)
    last_ones = [name for name in behind if depths[name] == deepest]
    return next((name for name in last_ones if name != last and tree.above[name].offset), last_ones[0])


def fixed_below(tree: LinkTree, link: str) -> dict[str, int]:
    """Links fixed to `link`, itself included, with the number of fixed joints between."""
    found, edge = {link: 0}, [link]
    for name in edge:
        for joint in tree.below.get(name, []):
            if not joint.moves:
                found[joint.child] = found[name] + 1
                edge.append(joint.child)
    return found


def _barred(tree: LinkTree, name: str, last: str):
    """For every link between, and itself: is it one of those that are never taken?"""
    while name != last:
        yield is_aside(name) or is_stub(name)
        name = tree.above[name].parent
