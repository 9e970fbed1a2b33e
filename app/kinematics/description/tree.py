"""Links and joints of a description as a tree."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from app.errors import FileFormatError, UnknownNameError

MOVING = ("revolute", "continuous", "prismatic")


@dataclass(frozen=True, eq=False)
class JointElement:
    """One joint, by name: what it joins and how it moves.

    Args:
        name: its own.
        kind: URDF's type.
        parent: link it stands on.
        child: link it carries.
        element: the XML.
    """

    name: str
    kind: str
    parent: str
    child: str
    element: ET.Element

    @property
    def moves(self) -> bool:
        return self.kind != "fixed"

    @property
    def mimics(self) -> str | None:
        """Name of the joint this one follows, or None."""
        mimic = self.element.find("mimic")
        return None if mimic is None else mimic.get("joint", "")

    @property
    def offset(self) -> bool:
        """True where the joint stands somewhere else than its parent link's origin."""
        origin = self.element.find("origin")
        if origin is None:
            return False
        numbers = (origin.get("xyz", "") + " " + origin.get("rpy", "")).split()
        return any(float(v) != 0 for v in numbers)


@dataclass(frozen=True, eq=False)
class LinkTree:
    """A whole description.

    Args:
        path: the file, for messages.
        links: names of links in the file's order, each with its XML.
        joints: in the file's order.
    """

    path: Path
    links: dict[str, ET.Element]
    joints: tuple[JointElement, ...]

    @cached_property
    def above(self) -> dict[str, JointElement]:
        """The joint that carries each link."""
        return {joint.child: joint for joint in self.joints}

    @cached_property
    def below(self) -> dict[str, list[JointElement]]:
        """The joints that stand on each link."""
        found: dict[str, list[JointElement]] = {}
        for joint in self.joints:
            found.setdefault(joint.parent, []).append(joint)
        return found

    @cached_property
    def root(self) -> str:
        """The link that nothing carries."""
        return next(name for name in self.links if name not in self.above)

    def chain(self, tip: str, base: str | None = None) -> list[JointElement]:
        """Joints from `base` (None: the root) to `tip`.

        Raises:
            UnknownNameError: a link that is not there.
            FileFormatError: `base` is not between the root and `tip`.
        """
        for name in (tip, base):
            if name is not None and name not in self.links:
                raise UnknownNameError(name, available=self.links, what="link", file=self.path)
        joints, link = [], tip
        while link != base and link in self.above:
            joints.append(self.above[link])
            link = self.above[link].parent
        if base is not None and link != base:
            raise FileFormatError(
                f"link {tip!r} is not carried by link {base!r}",
                file=self.path,
                expected=f"--chain BASE..TIP with BASE one of {', '.join(self._upwards(tip))}",
            )
        return joints[::-1]

    def _upwards(self, tip: str) -> list[str]:
        names = [joint.parent for joint in self.chain(tip)]
        return names[-12:]


def tree_of(root: ET.Element, path: Path) -> LinkTree:
    """The tree of a description whose numbers have been checked.

    Raises:
        FileFormatError: no links, a joint without its ends, a link carried twice, a loop.
    """
    links: dict[str, ET.Element] = {}
    for link in root.findall("link"):
        name = link.get("name", "")
        if name in links:
            raise FileFormatError(f"two links are called {name!r}", file=path, expected="names of their own")
        links[name] = link
    if not links:
        raise FileFormatError("no links", file=path, expected="a URDF file with links and joints")
    joints, carried, seen = [], set[str](), set[str]()
    for element in root.findall("joint"):
        joint = _joint(element, path)
        for end in (joint.parent, joint.child):
            if end not in links:
                raise FileFormatError(
                    f"joint {joint.name!r} joins a link {end!r} that is not there", file=path, expected="it"
                )
        if joint.name in seen:
            raise FileFormatError(
                f"two joints are called {joint.name!r}", file=path, expected="names of their own"
            )
        if joint.child in carried:
            raise FileFormatError(
                f"link {joint.child!r} hangs on two joints (a loop?)", file=path, expected="a tree of links"
            )
        seen.add(joint.name)
        carried.add(joint.child)
        joints.append(joint)
    tree = LinkTree(path, links, tuple(joints))
    reached, edge = set[str](), [name for name in links if name not in tree.above]
    if len(edge) > 1 and not any(tree.below.get(name) for name in edge):
        edge = edge[:1]
    while edge:
        link = edge.pop()
        reached.add(link)
        edge += [joint.child for joint in tree.below.get(link, [])]
    if any(joint.child not in reached for joint in joints):
        raise FileFormatError("the joints form a loop", file=path, expected="a tree of links")
    roots = [name for name in links if name not in tree.above and tree.below.get(name)]
    if len(roots) > 1:
        raise FileFormatError(
            f"{len(roots)} trees, from {', '.join(roots[:6])}", file=path, expected="one tree of links"
        )
    if roots:  # links that hang nowhere are left out
        tree = LinkTree(
            path,
            {n: e for n, e in links.items() if n in reached and (n in tree.above or n == roots[0])},
            tree.joints,
        )
    return tree


def _joint(element: ET.Element, path: Path) -> JointElement:
    name = element.get("name", "")
    parent, child = element.find("parent"), element.find("child")
    if parent is None or child is None:
        raise FileFormatError(f"joint {name!r} lacks its parent or child", file=path, expected="both")
    return JointElement(name, element.get("type", ""), parent.get("link", ""), child.get("link", ""), element)
