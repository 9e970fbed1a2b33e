"""What a pendant shows beyond what a real cell would: an exercise may take it away."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Aids:
    """Which helps the operator has. A session's are changed with `Context.allow`.

    Args:
        distance: tip to spike as a number; without it only the contact itself is felt.
        closeup: views that go near the tip.
        next_touch: the proposal of the next touch.
        handle: the drag handle.
        touch: a hand that brings the tip to the spike (strokes are always there); in a cell of two robots the
            buttons that run the procedure.
        light: whether the tip touches is told, by a light, a colour, a word.
    """

    distance: bool = True
    closeup: bool = True
    next_touch: bool = True
    handle: bool = True
    touch: bool = True
    light: bool = True
