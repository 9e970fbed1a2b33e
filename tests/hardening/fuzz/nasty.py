"""What a cell, a value or a text may hold and mostly should not; and how a good text is spoilt."""

from __future__ import annotations

import numpy as np

CELLS = (
    "", "0", "-0", "1", "-1", "2.5", "1e-320", "1e308", "-1e308", "1e400", "nan", "inf", "-inf", "NaN", "0x10", "1_0",
    "１", "∞", "abc", "-", "--", "'", '"', '""', ";", ",", "\t", "#", "\x00", "\x1b[2J", "﻿", "a" * 300, "9" * 400,
    "${1/0}", "${", "[", "]", "{", "}", "<", ">", "&", "<!DOCTYPE a>", "../../etc/passwd", "/dev/zero", "ur10e",
)  # fmt: skip
VALUES = (
    None, True, False, 0, 1, -1, 2, 7, 10**30, 2**63, 1e308, -1e308, 1e-320, 0.5, -2.7, "", "x", "ur10e", "joint",
    "/etc/passwd", "a" * 5000, [], [0.0], [0.0] * 6, [[0.0] * 6] * 4, {}, {"a": 1}, [[[[[[[[[[1]]]]]]]]]], "nan", "1",
)  # fmt: skip


def pick(rng: np.random.Generator, options):
    return options[int(rng.integers(len(options)))]


def spoilt(rng: np.random.Generator, text: str, most: int = 4) -> str:
    """A good text with a few pieces cut out, doubled, moved or replaced."""
    for _ in range(int(rng.integers(0, most + 1))):
        a, b = sorted(int(v) for v in rng.integers(0, len(text) + 1, 2))
        b = min(b, a + int(rng.integers(0, 60)))
        how = int(rng.integers(5))
        if how == 0:
            text = text[:a] + text[b:]
        elif how == 1:
            text = text[:a] + text[a:b] * int(rng.integers(2, 5)) + text[b:]
        elif how == 2:
            text = text[:a] + pick(rng, CELLS) + text[b:]
        elif how == 3:
            text = text[:a] + pick(rng, CELLS) + text[a:]
        else:
            text = text[:b] + text[a:b] + text[b:]
    return text


def spoilt_value(rng: np.random.Generator, value, chance: float = 0.08):
    """A JSON value with parts of it replaced, left out or doubled."""
    if rng.random() < chance:
        return pick(rng, VALUES)
    if isinstance(value, dict):
        kept = {k: spoilt_value(rng, v, chance) for k, v in value.items() if rng.random() > 0.02}
        if rng.random() < 0.03:
            kept[pick(rng, ("joint", "x", "", "a" * 200))] = pick(rng, VALUES)
        return kept
    if isinstance(value, list):
        kept = [spoilt_value(rng, v, chance / 2) for v in value if rng.random() > 0.01]
        return kept + kept[:1] * int(rng.random() < 0.03)
    return value
