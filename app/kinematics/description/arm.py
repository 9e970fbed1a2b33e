"""Which joints of a description are the arm, and what there is to choose from.

Rules, where neither a flange nor a chain is asked for:
1. A joint is no arm joint where it is a gripper's: nothing but such joints move behind it, and its name or its
   link's says so (jaw, finger; gripper, unless fingers or a tool point are fixed to its link: then it turns the
   gripper); or it is the last one and beside it a fixed link is called tcp, tool, eef or frame.
2. A joint that follows another (`<mimic>`) of its own line moves with it and has no column of its own; one that
   follows a joint beside it is a gripper's, and so is that joint.
3. The arm is the line with most joints left. A branch with fewer (a head, a screen, a camera) never shortens it; where
   branches of one place are equally long, or have two joints and more behind four others, a hand begins there.
4. Two lines that each have three or more joints of their own are two arms, and the choice is asked for.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from app.errors import FileFormatError
from app.kinematics.description.accessories import is_aside, is_finger, is_gripper
from app.kinematics.description.address import Address
from app.kinematics.description.flange import default_flange, fixed_below
from app.kinematics.description.tree import MOVING, JointElement, LinkTree

_OWN = 3  # joints of its own that make a branch an arm
_BEFORE_A_HAND, _FINGER = 4, 2  # joints in front of a hand, and of each of its fingers
_MOST_LISTED = 12
#: In a row: snakes and hyper-redundant arms have some 40; the time of an inverse grows with the cube.
MOST_JOINTS = 100
_TOOL_POINT = re.compile(
    r"(?:.*[_\-/])?(?:tcp|tool0?|eef?|flange|end_?effector)(?:[_\-/](?:link|frame))?\Z|.*_frame(?:_link)?\Z",
    re.I,
)


@dataclass(frozen=True, eq=False)
class Arm:
    """The part of a description that is the arm.

    Args:
        base: its first link; poses are in its frame.
        flange: the link tools are bolted to.
        chain: every joint from base to flange.
        chosen: True where a person named the flange or the chain.
    """

    base: str
    flange: str
    chain: tuple[JointElement, ...]
    chosen: bool

    @property
    def moving(self) -> list[JointElement]:
        """Joints that move on their own, base to flange."""
        names = {joint.name for joint in self.chain}
        return [j for j in self.chain if j.moves and j.mimics not in names]

    @property
    def following(self) -> list[JointElement]:
        """Joints of the chain that follow one of its others."""
        names = {joint.name for joint in self.chain}
        return [j for j in self.chain if j.moves and j.mimics in names]


def find_arm(tree: LinkTree, address: Address) -> Arm:
    """The arm that is asked for, else the one the rules find.

    Raises:
        FileFormatError: no moving joint, one of a kind that no arm has, or several arms to choose from.
        UnknownNameError: a link that is not there.
    """
    base = tree.root
    if address.chain is not None:
        base, tip = address.chain
        flange = address.flange or tip
    elif address.flange is not None:
        flange = address.flange
    else:
        flange = default_flange(tree, _last_link(tree))
    arm = Arm(
        base, flange, tuple(tree.chain(flange, base)), address.flange is not None or address.chain is not None
    )
    if not arm.moving:
        raise FileFormatError("0 moving joints", file=tree.path, expected="1 or more in a row")
    if len(arm.moving) > MOST_JOINTS:
        raise FileFormatError(
            f"{len(arm.moving)} moving joints", file=tree.path, expected=f"at most {MOST_JOINTS} in a row"
        )
    for joint in arm.chain:
        if joint.moves and joint.kind not in MOVING:
            raise FileFormatError(
                f"joint {joint.name!r} is of type {joint.kind!r}",
                file=tree.path,
                expected="revolute, continuous or prismatic",
            )
    return arm


def _last_link(tree: LinkTree) -> str:
    """The link that the arm's last joint carries."""
    ends = _ends(tree, _gripper_joints(tree))
    if not ends:
        return tree.root
    own = {link: [joint for joint in chain if joint.mimics is None] for link, chain in ends.items()}
    most = max(map(len, own.values()))
    longest = [link for link, joints in own.items() if len(joints) == most]
    best = next((link for link in longest if not is_aside(link)), longest[0])
    rivals, last, fewest = [best], best, most
    for link, joints in own.items():
        shared = sum(a is b for a, b in zip(own[best], joints, strict=False))
        least = min(most, len(joints)) - shared
        if link == best or least == 0 or any(is_aside(j.name) or is_aside(j.child) for j in joints[shared:]):
            continue
        hand = shared >= _BEFORE_A_HAND and least >= _FINGER
        if least >= _OWN and not hand:
            rivals.append(link)
        elif (hand or len(joints) == most) and 0 < shared < fewest:  # a hand begins, fingers are no arm
            fewest, last = shared, own[best][shared - 1].child
    if len(rivals) > 1:
        raise FileFormatError(
            f"{len(rivals)} arms: {_listed(tree, rivals)}",
            file=tree.path,
            expected="--chain BASE..TIP (in a header '# chain: BASE..TIP')",
        )
    return last


def _listed(tree: LinkTree, links: list[str]) -> str:
    shown = [
        f"{tree.root}..{default_flange(tree, link)} "
        f"({sum(j.moves and j.mimics is None for j in tree.chain(link))} joints)"
        for link in links[:_MOST_LISTED]
    ]
    more = len(links) - len(shown)
    return ", ".join(shown) + (f" and {more} more" if more else "")


def _ends(tree: LinkTree, grippers: set[str]) -> dict[str, list[JointElement]]:
    """The last moved link of every branch, with the arm joints that lead to it, in the file's order."""
    found: dict[str, list[JointElement]] = {}
    edge: list[tuple[str, list[JointElement]]] = [(tree.root, [])]
    while edge:
        link, chain = edge.pop()
        if chain and chain[-1].child == link:
            if len(chain) > 1:
                found.pop(chain[-2].child, None)
            found[link] = chain
        edge += [
            (joint.child, [*chain, joint] if joint.moves else chain)
            for joint in reversed(tree.below.get(link, []))
            if joint.name not in grippers
        ]
    return found


def _gripper_joints(tree: LinkTree) -> set[str]:
    """Names of the moving joints that are a gripper's, see rules 1 and 2."""
    movers = _moving_below(tree)
    found: set[str] = set()
    followed: set[str] = set()
    leaves_first = sorted(
        (j for j in tree.joints if j.moves), key=lambda j: (len(movers[j.child]), j.mimics is None)
    )
    for joint in leaves_first:
        if not all(name in found for name in movers[joint.child]):
            continue
        named = (
            is_finger(joint.name)
            or is_finger(joint.child)
            or (is_gripper(joint.name) and not _carries(tree, joint))
        )
        aside = joint.mimics is not None and all(a.name != joint.mimics for a in tree.chain(joint.parent))
        if named or aside or joint.name in followed or _beside_a_tool_point(tree, joint, movers):
            found.add(joint.name)
            if aside and joint.mimics:
                followed.add(joint.mimics)
    return found


def _carries(tree: LinkTree, joint: JointElement) -> bool:
    """True where a joint's link has a tool point or fingers fixed to it: it turns the gripper, it is not one."""
    return any(
        _TOOL_POINT.match(name) or is_gripper(name)
        for name in fixed_below(tree, joint.child)
        if name != joint.child
    )


def _beside_a_tool_point(tree: LinkTree, joint: JointElement, movers: dict[str, list[str]]) -> bool:
    """True where a last moving joint stands beside a fixed link that is called as tools' places are."""
    if movers[joint.child]:
        return False
    return any(
        not other.moves and _TOOL_POINT.match(other.child) and not is_aside(other.child)
        for other in tree.below.get(joint.parent, [])
    )


def _moving_below(tree: LinkTree) -> dict[str, list[str]]:
    """Names of the moving joints behind every link."""
    order, edge = [], [tree.root]
    while edge:
        link = edge.pop()
        order.append(link)
        edge += [joint.child for joint in tree.below.get(link, [])]
    found: dict[str, list[str]] = {}
    for link in reversed(order):
        names: list[str] = []
        for joint in tree.below.get(link, []):
            names += ([joint.name] if joint.moves else []) + found[joint.child]
        found[link] = names
    return found
