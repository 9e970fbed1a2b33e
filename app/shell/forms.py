"""Forms: their pages, and what comes back from them. A form carries a token that only a page of ours can have.

The token is made from a random cookie, the log-in and the server's key (signed double submit): a page from elsewhere
has neither, and one browser's token is of no use in another.
"""

from __future__ import annotations

import hmac
import json
import secrets
from typing import Any
from urllib.parse import parse_qsl, quote, unquote

from starlette.requests import HTTPConnection, Request
from starlette.responses import HTMLResponse, Response

from app.errors import TeachframeError
from app.figures import in_markup
from app.people.limits import FORM
from app.shell.entrance import Entrance
from app.shell.security import COOKIE, FORM_COOKIE, HEADERS, LOOK_COOKIE
from app.templating import templates
from app.texts import error_text, languages, text

_FIELDS = 20  # of a form, where nothing else is said
_HOUR = 3600  # seconds a form may lie open
_PAGES = templates(__file__, forms=True)
#: A page of a form needs no script at all.
FORM_POLICY = (
    "default-src 'none'; style-src 'self'; img-src 'self'; "
    "form-action 'self'; frame-ancestors 'none'; base-uri 'none'"
)


def language_of(request: Request) -> str:
    """What was chosen on a page of ours, else what the browser asks for, else English."""
    chosen = request.query_params.get("language")
    if chosen in languages():
        return str(chosen)
    kept = _look(request).get("language")
    if kept in languages():
        return str(kept)
    wished = [part.partition(";")[0].strip()[:2].lower() for part in _accepted(request).split(",")]
    return next((language for language in wished if language in languages()), "en")


def page(
    entrance: Entrance,
    request: Request,
    name: str,
    *,
    status: int = 200,
    error: TeachframeError | None = None,
    policy: str = FORM_POLICY,
    **fields: Any,
) -> Response:
    """A page of forms from its template.

    Args:
        entrance: makes the token.
        request: what asked for it.
        name: of the template, without its ending.
        status: of the answer.
        error: what is said above the form.
        policy: what the page may load; without a word no script.
        fields: for the template.
    """
    language = language_of(request)
    cookie = request.cookies.get(FORM_COOKIE) or secrets.token_urlsafe(24)
    written = _PAGES.get_template(f"{name}.html").render(
        t=lambda key, **details: text(key, language, **details),
        language=language,
        languages=languages(),
        dark=is_dark(request),
        root=request.scope.get("root_path", ""),
        here=request.url.path,
        token=_token(entrance, request, cookie),
        error=None if error is None else error_text(error, language),
        **fields,
    )
    headers = {**HEADERS, "Content-Security-Policy": policy, "Cache-Control": "no-store"}
    # What is read is put as it is read; what stands in fields comes back and stays as it was typed.
    answer = HTMLResponse(in_markup(written), status, headers)
    entrance.set(answer, request, FORM_COOKIE, cookie, _HOUR)
    if request.query_params.get("language") in languages():
        remember(answer, request, language)
    return answer


async def filled(
    entrance: Entrance, request: Request, *, fields: int = _FIELDS, largest: int = FORM
) -> dict[str, str] | None:
    """What a form says; None where it is no form of ours: another kind, without its token, or larger than so many
    fields and bytes."""
    if (
        request.headers.get("content-type", "").partition(";")[0].strip()
        != "application/x-www-form-urlencoded"
    ):
        return None
    content = b""
    async for piece in request.stream():
        content += piece
        if len(content) > largest:
            return None
    try:
        said = dict(parse_qsl(content.decode(), keep_blank_values=True, max_num_fields=fields))
    except ValueError:
        return None
    cookie = request.cookies.get(FORM_COOKIE, "")
    expected = _token(entrance, request, cookie)
    given = said.pop("token", "").encode("utf-8", "replace")
    return said if cookie and hmac.compare_digest(expected.encode(), given) else None


def _token(entrance: Entrance, request: Request, cookie: str) -> str:
    what = f"form\0{cookie}\0{request.cookies.get(COOKIE, '')}"
    return hmac.new(entrance.key, what.encode("utf-8", "surrogatepass"), "sha256").hexdigest()


def _accepted(request: Request) -> str:
    return request.headers.get("accept-language", "")[:200]


def is_dark(request: HTTPConnection) -> bool:
    """True where the pages of this browser are dark."""
    return _look(request).get("dark") is True


def _look(request: HTTPConnection) -> dict[str, Any]:
    """How the pendant's page looked last in this browser: its own words, not trusted."""
    try:
        kept = json.loads(unquote(request.cookies.get(LOOK_COOKIE, "")))
    except (ValueError, RecursionError):
        return {}
    return kept if isinstance(kept, dict) else {}


def remember(answer: Response, request: Request, language: str) -> None:
    """The choice is kept where the pendant's page keeps its own; a script of ours reads it there."""
    answer.set_cookie(
        LOOK_COOKIE,
        quote(json.dumps({**_look(request), "language": language}), safe=""),
        max_age=400 * 24 * 3600,
        path=request.scope.get("root_path") or "/",
        samesite="strict",
        secure=request.url.scheme == "https",
    )
