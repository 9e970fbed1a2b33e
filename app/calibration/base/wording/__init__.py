"""What base frames say, in words of several languages: `en.toml`, `zh.toml`, keys only in the code.

check.KEY, check.KEY_do      what a check saw, and what to do next
refused.KEY, refused.KEY_do  why the points cannot determine the base, or why a step of the wizard cannot be done
note, step                   what nothing can settle; the rows of the wizard
report, arm, poses           the pages of text
"""

from __future__ import annotations

from pathlib import Path

from app.calibration.wording.family import Family

__all__ = ["TEXTS", "degenerate", "phrase", "refused", "remark"]

_FAMILY = Family(Path(__file__).parent)
TEXTS = _FAMILY.texts
phrase, remark = _FAMILY.phrase, _FAMILY.remark
degenerate, refused = _FAMILY.degenerate, _FAMILY.refused
