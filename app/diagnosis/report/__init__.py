"""What a diagnosis says, for a person.

budget.py    where the error comes from: families as amounts that add up, and the sentence
wording.py   names, places and numbers as one writes them
curves.py    residual against what it may follow, as numbers
events.py    what happened at a time
picture_words.py  labels of pictures in the reader's language
text.py      the terminal's version
page.py      the page: one HTML file without anything from outside, made to be printed
style.py     its look
templating.py, templates/  its HTML, with autoescape
parts/       one file a section of the page
drawing/     one file a kind of picture, plain SVG
"""

from app.diagnosis.report.page import as_page, write_report
from app.diagnosis.report.text import as_text

__all__ = ["as_page", "as_text", "write_report"]
