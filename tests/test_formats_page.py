"""docs/formats.md: every format that is read has its row, and every row a test that is there."""

import re
from pathlib import Path

from app import catalog

ROOT = Path(__file__).parents[1]
PAGE = (ROOT / "docs" / "formats.md").read_text(encoding="utf-8")


def test_every_test_that_is_named_is_there():
    named = re.findall(r"`(tests/[\w/.]+)`", PAGE)
    assert len(named) > 20 and not [name for name in named if not (ROOT / name).exists()]


def test_every_format_has_its_row():
    forms = catalog.members("app.recordings.formats", "FORMAT")
    rows = [line for line in PAGE.splitlines() if line.startswith("|")]
    missing = [key for key in forms if not any(f"`{key}`" in row.split("|")[1] for row in rows)]
    assert not missing


def test_every_tool_frame_and_every_simulator_has_its_row():
    first = [line.split("|")[1] for line in PAGE.splitlines() if line.startswith("|")]
    keys = catalog.members("app.calibration.exchange", "FORMAT")
    assert len(keys) > 6 and not [key for key in keys if not any(f"`{key}`" in cell for cell in first)]
    targets = [key.upper() for key in catalog.members("app.diagnosis.export.targets", "TARGET")]
    assert not [target for target in targets if not any(target in cell for cell in first)]


def test_every_row_names_a_test():
    rows = [line for line in PAGE.splitlines() if line.startswith("| ") and "held by" not in line]
    assert len(rows) >= 36 and not [row for row in rows if "`tests/" not in row]
