"""Descriptions made for a test: joints in a few words, links by themselves."""

from __future__ import annotations

from pathlib import Path

LIMIT = '<limit lower="-2.9" upper="2.9" velocity="2" effort="20"/>'


def joint(name, parent, child, *, kind="revolute", xyz="0 0 0.1", axis="0 1 0", inner=""):
    """One joint as XML."""
    moves = "" if kind == "fixed" else f'<axis xyz="{axis}"/>{LIMIT}{inner}'
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{xyz}"/>{moves}</joint>'
    )


def fixed(name, parent, child, xyz="0 0 0"):
    """One that does not move."""
    return joint(name, parent, child, kind="fixed", xyz=xyz)


def line(count, *, base="base", prefix=""):
    """A line of turning joints j1… from `base` to l{count}."""
    names = [base, *(f"{prefix}l{k}" for k in range(1, count + 1))]
    return [
        joint(f"{prefix}j{k}", names[k - 1], names[k], axis="0 0 1" if k % 2 else "0 1 0")
        for k in range(1, count + 1)
    ]


def description(joints, *, extra="", name="r"):
    """A whole URDF; its links are those the joints speak of."""
    text = "".join(joints)
    links = dict.fromkeys(part.split('"')[0] for part in text.split('link="')[1:])
    return f'<robot name="{name}">{"".join(f"<link name={chr(34)}{n}{chr(34)}/>" for n in links)}{text}{extra}</robot>'


def written(folder: Path, joints, *, file="arm.urdf", extra="") -> Path:
    """The same in a file."""
    path = folder / file
    path.write_text(description(joints, extra=extra))
    return path
