"""Log in by a school's own provider, instead of a password here."""

from __future__ import annotations

import asyncio
import hmac

import msgspec
from starlette.requests import Request
from starlette.responses import HTMLResponse, RedirectResponse, Response
from starlette.routing import Route

from app.errors import PersonRefusedError, StorageError
from app.people import People, Person
from app.people.limits import TRIES_OF_ADDRESS
from app.people.person import LONGEST_TRIED
from app.people.refusals import refused
from app.shell.coming_in import ComingIn
from app.shell.entrance import Entrance
from app.shell.forms import FORM_POLICY, page
from app.shell.provider import Asked, Provider, Vouched
from app.shell.security import HEADERS

_AWAY = 600  # seconds somebody may be away at the provider
_COOKIE = "teachframe_outside"
LOGIN = "/login/outside"


class Outside:
    """Routes to the provider and back.

    Args:
        entrance: sets cookies.
        people: the accounts; who is not among them yet becomes a trainee.
        provider: who vouches.
        coming_in: lets in who is known.
    """

    def __init__(self, entrance: Entrance, people: People, provider: Provider, coming_in: ComingIn):
        self._entrance, self._people, self._provider, self._in = entrance, people, provider, coming_in
        self.routes = [Route(LOGIN, self._leave), Route(f"{LOGIN}/back", self._back)]

    async def _leave(self, request: Request) -> Response:
        try:
            url, asked = await asyncio.to_thread(self._provider.ask, _back_to(request))
        except StorageError as error:
            return page(
                self._entrance, request, "login", status=503, error=error, said={}, outside=self._in.outside
            )
        answer = RedirectResponse(url, 303, HEADERS)
        content = msgspec.json.encode(asked).hex()
        # Lax, not strict: the way back begins on the provider's page.
        answer.set_cookie(
            _COOKIE,
            f"{content}.{self._signature(content)}",
            max_age=_AWAY,
            path=f"{request.scope.get('root_path', '')}{LOGIN}",
            httponly=True,
            samesite="lax",
            secure=request.url.scheme == "https",
        )
        return answer

    async def _back(self, request: Request) -> Response:
        try:
            asked = self._remembered(request)
            state, code = request.query_params.get("state", ""), request.query_params.get("code", "")
            back = _back_to(request)
            vouched = await asyncio.to_thread(self._provider.answer, asked, state, code, back)
            address = request.client.host if request.client else ""
            person = await asyncio.to_thread(self._known, vouched, address)
        except (PersonRefusedError, StorageError) as error:
            status = 401 if isinstance(error, PersonRefusedError) else 503
            return page(
                self._entrance,
                request,
                "login",
                status=status,
                error=error,
                said={},
                outside=self._in.outside,
            )
        entered = await self._in.welcome(request, person)
        # A redirect would still count as the provider's, and the new cookie stay at home; a page of ours does not.
        home = f"{request.scope.get('root_path', '')}/"
        content = f'<!doctype html><meta charset="utf-8"><meta http-equiv="refresh" content="0;url={home}">'
        headers = {**HEADERS, "Content-Security-Policy": FORM_POLICY, "Cache-Control": "no-store"}
        answer = HTMLResponse(content, 200, headers)
        answer.raw_headers += [(k, v) for k, v in entered.raw_headers if k == b"set-cookie"]
        answer.delete_cookie(_COOKIE, path=f"{request.scope.get('root_path', '')}{LOGIN}")
        return answer

    def _known(self, vouched: Vouched, address: str) -> Person:
        """The account of whom the provider vouches for; made where there is none. Names are never what is asked."""
        if not self._people.tries.count(TRIES_OF_ADDRESS, "outside", address):
            raise refused("slowly", most=TRIES_OF_ADDRESS.most)
        person = self._people.vouched(vouched.outside)
        if person is None:
            person = self._added(vouched)
        if person.disabled:
            raise refused("wrong")
        self._people.audit.note(person.id, "log_in")
        return person

    def _added(self, vouched: Vouched) -> Person:
        name = "".join(vouched.login.split())[:LONGEST_TRIED] or "person"
        for number in range(1, 100):
            login = name if number == 1 else f"{name}-{number}"
            try:
                return self._people.add(
                    login, vouched.name[:LONGEST_TRIED], "trainee", "", outside=vouched.outside
                )
            except PersonRefusedError as error:
                if error.why != "taken":
                    raise
        raise refused("taken", login=name)

    def _remembered(self, request: Request) -> Asked:
        content, _, signature = request.cookies.get(_COOKIE, "").rpartition(".")
        if not content or not hmac.compare_digest(self._signature(content).encode(), signature.encode()):
            raise refused("stale")
        try:
            return msgspec.json.decode(bytes.fromhex(content), type=Asked)
        except (ValueError, msgspec.DecodeError):
            raise refused("stale") from None

    def _signature(self, content: str) -> str:
        return hmac.new(
            self._entrance.key, f"outside {content}".encode("utf-8", "replace"), "sha256"
        ).hexdigest()


def _back_to(request: Request) -> str:
    return f"{request.url.scheme}://{request.headers.get('host', '')}{request.scope.get('root_path', '')}{LOGIN}/back"
