"""What many recordings say together.

seen.py     rows as what was found in which arm when
shared.py   which arms share which effect
drift.py    what changes in an arm over months
news.py     what the last run brought
page.py     all of it as a page and as text
"""

from app.fleet.summary.page import Summary, as_page, as_text, summarised

__all__ = ["Summary", "as_page", "as_text", "summarised"]
