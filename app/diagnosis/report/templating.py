"""The page's templates: Jinja2 with autoescape, so that no text of a file or a person can become markup."""

from __future__ import annotations

from markupsafe import Markup

from app.templating import templates


def render(name: str, /, **fields: object) -> Markup:
    """One template of the folder, filled in; what it gives is markup, every text in it escaped."""
    return Markup(templates(__file__).get_template(name).render(**fields))


def drawn(picture: str) -> Markup:
    """A picture of `drawing/`, whose texts are escaped where they are drawn."""
    return Markup(picture)
