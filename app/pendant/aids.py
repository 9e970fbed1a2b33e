"""What a pendant shows beyond what a real cell would: an exercise may take it away."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Aids:
    """Which helps the operator has. A pendant's are changed with `Pendant.allow`.

    Args:
        distance: tip to spike as a number; without it only the contact itself is felt.
        closeup: views that go near the tip.
        next_touch: the proposal of the next touch.
        handle: the drag handle.
        touch: a hand that brings the tip to the spike; strokes along the tool's axes are always there.
    """

    distance: bool = True
    closeup: bool = True
    next_touch: bool = True
    handle: bool = True
    touch: bool = True
