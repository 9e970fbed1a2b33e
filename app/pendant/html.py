"""Small pieces of page. Everything that comes from outside is escaped here and nowhere else."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

#: Colours of the traffic light and of messages; readable on light and dark ground.
COLOURS = {"green": "#2f9e44", "yellow": "#e8890c", "red": "#e03131", "grey": "#868e96", "blue": "#1c7ed6"}
LEVELS = {"info": "blue", "good": "green", "warning": "yellow", "error": "red"}
_FONT = "font-size:12px;line-height:1.45;font-variant-numeric:tabular-nums"


def block(inner: str, *, testid: str = "", style: str = "") -> str:
    """A block of already safe markup, with a hook for tests."""
    hook = f' data-testid="{escape(testid)}"' if testid else ""
    return f'<div{hook} style="{_FONT};padding:2px 10px;{style}">{inner}</div>'


def paragraph(text: str, *, testid: str = "", faint: bool = False, style: str = "") -> str:
    """One paragraph of plain text."""
    look = "opacity:.72;" if faint else ""
    return block(escape(text), testid=testid, style=look + style)


def instruction(title: str, words: str) -> str:
    """What to do next, marked at its edge."""
    inner = f'<div style="font-weight:600">{escape(title)}</div><div style="opacity:.8">{escape(words)}</div>'
    return block(inner, testid="next", style="border-left:4px solid #d66014;margin:6px 10px;min-height:54px")


def lamp(colour: str, size: int = 12) -> str:
    """A round lamp."""
    return (
        f'<span style="display:inline-block;width:{size}px;height:{size}px;border-radius:50%;'
        f'background:{COLOURS[colour]};margin-right:7px;vertical-align:-1px;flex:none"></span>'
    )


def light(colour: str, text: str, *, testid: str = "light") -> str:
    """The traffic light with its reason."""
    inner = f"{lamp(colour, 16)}<span>{escape(text)}</span>"
    return block(
        f'<span data-colour="{colour}" style="display:flex;align-items:center">{inner}</span>',
        testid=testid,
        style=f"border-left:4px solid {COLOURS[colour]};padding:6px 10px;margin:2px 0;font-size:12.5px",
    )


def table(
    rows: Iterable[Sequence[str]],
    *,
    head: Sequence[str] = (),
    testid: str = "",
    widths: Sequence[str] = (),
) -> str:
    """Plain texts in rows; the first column reads left, all others right."""
    out = []
    columns = [f'<col style="width:{width}">' for width in widths]
    if head:
        cells = "".join(_cell(text, i, "th", "font-weight:600;opacity:.6") for i, text in enumerate(head))
        out.append(f"<tr>{cells}</tr>")
    out.extend(f"<tr>{''.join(_cell(text, i, 'td') for i, text in enumerate(row))}</tr>" for row in rows)
    look = (
        "width:100%;border-collapse:collapse;table-layout:fixed"
        if widths
        else "width:100%;border-collapse:collapse"
    )
    return block(
        f'<table style="{look}"><colgroup>{"".join(columns)}</colgroup>{"".join(out)}</table>', testid=testid
    )


def _cell(text: str, column: int, tag: str, look: str = "") -> str:
    side = "left" if column == 0 else "right"
    edge = "border-bottom:1px solid rgba(128,128,128,.18);padding:1px 2px"
    return f'<{tag} style="text-align:{side};{edge};{look}">{escape(text)}</{tag}>'


def notes(items: Iterable[tuple[str, str]], *, testid: str = "notes") -> str:
    """Remarks, each with the colour of its level."""
    out = [
        f'<div style="display:flex;margin:5px 0"><span>{lamp(colour, 9)}</span><span>{escape(text)}</span></div>'
        for colour, text in items
    ]
    return block("".join(out), testid=testid) if out else ""


def bar(inner: str, *, testid: str, top: bool, left: int, right: int, colour: str) -> str:
    """A line across the canvas, at its top or its bottom, between the two panels."""
    edge = "top:0" if top else "bottom:0"
    return (
        f'<div data-testid="{escape(testid)}" style="position:fixed;{edge};left:{left}px;right:{right}px;'
        f"min-height:30px;display:flex;flex-wrap:wrap;align-items:center;gap:2px 14px;padding:3px 12px;z-index:50;"
        f"line-height:1.35;font-size:12.5px;font-variant-numeric:tabular-nums;color:#f1f3f5;"
        f'background:{colour}">{inner}</div>'
    )


def item(text: str, *, testid: str = "", strong: bool = False, colour: str = "", gives: bool = False) -> str:
    """One entry of a line; the one that `gives` breaks its words where the line is full, the others stay whole."""
    hook = f' data-testid="{escape(testid)}"' if testid else ""
    mark = lamp(colour, 10) if colour else ""
    weight = "font-weight:600;" if strong else ""
    room = "min-width:0;" if gives else "flex:none;white-space:nowrap;"
    return f'<span{hook} style="{weight}{room}">{mark}{escape(text)}</span>'
