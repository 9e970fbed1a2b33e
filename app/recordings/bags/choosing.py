"""Which joint states of a bag are the arm's: its joints are looked for by name over all topics and message sets."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from app.errors import FileFormatError, InputError, UnknownNameError
from app.kinematics.description.accessories import is_gripper
from app.recordings.bags.collecting import Series
from app.recordings.options import ReadOptions

#: Topics that say what was asked for, not what was.
_ASKED = re.compile(r"desired|command|target|reference|setpoint|goal", re.IGNORECASE)
_MOST_LISTED = 8


@dataclass(frozen=True)
class Fit:
    """A series that holds the arm's joints.

    Args:
        series: the messages.
        columns: where in its names each of the arm's joints is.
        prefix: what stands before the arm's own names there.
        by_name: False where joints are only taken in their order.
    """

    series: Series
    columns: tuple[int, ...]
    prefix: str = ""
    by_name: bool = True

    @property
    def asked(self) -> bool:
        """True where this is what was commanded."""
        return self.series.kind == "commanded" or bool(_ASKED.search(self.series.topic))


def choose(found: list[Series], options: ReadOptions, path: Path) -> tuple[Fit, Fit | None]:
    """The arm's joint states, and what was commanded where that is there too.

    Raises:
        UnknownNameError: no such topic.
        FileFormatError: none fits.
        InputError: several fit; says how to choose.
    """
    series = [s for s in found if s.kind in ("joints", "commanded")]
    if options.topic is not None:
        if all(s.topic != options.topic for s in series):
            raise UnknownNameError(
                options.topic, available={s.topic for s in series}, what="topic of joint states", file=path
            )
        measured = [f for s in series if s.topic == options.topic for f in _fits(s, options)]
    else:
        measured = [f for s in series if s.kind == "joints" for f in _fits(s, options)]
    if any(f.by_name for f in measured):
        measured = [f for f in measured if f.by_name]
    if not measured:
        raise _none_fits(series, options, path)
    plain = [f for f in measured if not f.asked]
    best = _the_one(plain or measured, options, path)
    names = tuple(best.series.names[k] for k in best.columns)
    asked = [
        f
        for s in series
        for f in _fits(s, ReadOptions(joint_names=names))
        if f.asked and f.by_name and s is not best.series and s.topic != options.topic
    ]
    return best, max(asked, key=lambda f: f.series.count) if asked else None


def _the_one(fits: list[Fit], options: ReadOptions, path: Path) -> Fit:
    exact = [f for f in fits if not f.prefix]
    fits = exact or fits
    if len(fits) == 1:
        return fits[0]
    if not options.joint_names:  # nobody said which arm: the fullest log
        return max(fits, key=lambda f: (len(f.columns) > 1, f.series.count))
    topics = {f.series.topic for f in fits}
    listed = ", ".join(
        f"{f.series.topic}{' ' + f.prefix if f.prefix else ''} ({f.series.count} messages)"
        for f in fits[:_MOST_LISTED]
    )
    by = [f"--prefix {f.prefix}" for f in fits if f.prefix] if len(topics) == 1 else []
    by = by or [f"--topic {topic}" for topic in sorted(topics)]
    raise InputError(
        f"{len(fits)} sets of joint states fit: {listed}", file=path, expected=" or ".join(by[:_MOST_LISTED])
    )


def _fits(series: Series, options: ReadOptions) -> list[Fit]:
    """How a series can be the arm's; empty where it cannot."""
    names, wanted = series.names, options.joint_names
    prefix = options.prefix
    if not wanted:
        own = [k for k, n in enumerate(names) if not is_gripper(n) and n.startswith(prefix or "")]
        return [Fit(series, tuple(own), prefix or "", by_name=False)] if own else []
    at = {name: k for k, name in enumerate(names)}
    found = []
    for front in _fronts(names, wanted) if prefix is None else [prefix]:
        columns = [at.get(front + name, at.get(name) if name.startswith(front) else None) for name in wanted]
        if all(k is not None for k in columns):
            found.append(Fit(series, tuple(int(k) for k in columns if k is not None), front))
    if found:
        return found
    shorter = [
        [k for k, name in enumerate(names) if name and w.endswith(name)] for w in wanted
    ]  # the description has the prefix, the log has none
    if prefix is None and all(len(k) == 1 for k in shorter) and len({k[0] for k in shorter}) == len(wanted):
        return [Fit(series, tuple(k[0] for k in shorter))]
    own = [k for k, n in enumerate(names) if not is_gripper(n) and n.startswith(prefix or "")]
    return [Fit(series, tuple(own), prefix or "", by_name=False)] if len(own) == len(wanted) else []


def _fronts(names: tuple[str, ...], wanted: tuple[str, ...]) -> list[str]:
    """What may stand before the first joint's own name; none at all first."""
    fronts = {name[: -len(wanted[0])] for name in names if name.endswith(wanted[0])}
    return sorted(fronts, key=lambda front: (len(front), front))


def _none_fits(series: list[Series], options: ReadOptions, path: Path) -> FileFormatError:
    listed = "; ".join(f"{s.topic}: {', '.join(s.names[:12])}" for s in series[:_MOST_LISTED])
    wanted = ", ".join(options.joint_names) or "joints"
    if options.prefix:
        wanted += f" with {options.prefix} before them"
    return FileFormatError(f"no joint states of this arm; there are {listed}", file=path, expected=wanted)
