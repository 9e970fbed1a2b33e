"""What a browser gets while no session can be kept: why, in one sentence, and the page again as soon as it can."""

from __future__ import annotations

from jinja2 import Environment
from starlette.responses import Response

from app.errors import TeachframeError
from app.shell.security import HEADERS, PAGE_POLICY

#: Seconds after which the browser asks again.
AGAIN = 5
_PAGE = Environment(autoescape=True).from_string(
    '<!doctype html><meta charset="utf-8"><meta http-equiv="refresh" content="{{ again }}"><title>Teachframe</title>'
    "<p>{{ reason }}</p><p>Asking again every {{ again }} s. · 每 {{ again }} 秒重试一次。</p>"
)


def unavailable(error: TeachframeError) -> Response:
    """503 with the reason; it asks again by itself."""
    text = _PAGE.render(reason=str(error), again=AGAIN)
    headers = {
        **HEADERS,
        "Content-Security-Policy": PAGE_POLICY,
        "Cache-Control": "no-store",
        "Retry-After": str(AGAIN),
    }
    return Response(text, 503, headers, media_type="text/html")
