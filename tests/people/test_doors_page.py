"""docs/doors.md says what the table says."""

import os
from pathlib import Path

from app.people.doors import DOORS
from app.people.doors_page import doors_page

PAGE = Path(__file__).parents[2] / "docs" / "doors.md"


def test_the_golden_page_of_doors_is_the_table():
    page = doors_page()
    if os.environ.get("TEACHFRAME_REWRITE_GOLDEN"):
        PAGE.write_text(page, encoding="utf-8")
    assert all(f"(`{key}`)" in page for key in DOORS)
    assert PAGE.read_text(encoding="utf-8") == page, "differs; if meant, `make golden` rewrites it"
