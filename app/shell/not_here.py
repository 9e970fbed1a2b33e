"""What somebody sees who mistyped an address, or follows a link of yesterday: that nothing is there, and a way back."""

from __future__ import annotations

from collections.abc import Callable

from jinja2 import Environment
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response

from app.shell.security import HEADERS, PAGE_POLICY

_PAGE = Environment(autoescape=True).from_string(
    '<!doctype html><meta charset="utf-8"><meta name="viewport" content="width=device-width,initial-scale=1">'
    "<title>Teachframe</title><p>There is nothing at this address. · 此地址没有内容。</p>"
    '<p><a href="{{ root }}/">To the pendant · 去示教器</a></p>'
)


def not_here(root: str) -> Callable[[Request, Exception], Response]:
    """The answer for a page that is none; programs get a line of text.

    Args:
        root: path under which everything stands; empty for none.
    """

    def answer(asked: Request, _: Exception) -> Response:
        if "text/html" not in asked.headers.get("accept", ""):
            return PlainTextResponse("Not Found", 404, HEADERS)
        headers = {**HEADERS, "Content-Security-Policy": PAGE_POLICY, "Cache-Control": "no-store"}
        return Response(_PAGE.render(root=root), 404, headers, media_type="text/html")

    return answer
