"""A school's OpenID Connect provider: where to send somebody, and who came back. The protocol is authlib's."""

from __future__ import annotations

import secrets
import threading
from dataclasses import dataclass
from typing import Any
from urllib.parse import urlsplit

from app.errors import InputError, StorageError
from app.people.refusals import refused

#: Seconds a provider has to answer.
_ANSWER = 10.0
#: Seconds by which its clock may differ from ours.
_CLOCKS = 120
_SIGNED = ["RS256", "PS256", "ES256", "EdDSA"]  # never "none", never by a shared secret
_LONGEST = 255  # characters of issuer and subject together


@dataclass(frozen=True)
class Asked:
    """What is remembered while somebody is away: all of it is random."""

    state: str
    nonce: str
    verifier: str


@dataclass(frozen=True)
class Vouched:
    """Whom a provider vouches for.

    Args:
        outside: issuer and subject: who it is, whatever he is called.
        login: what he may be called here.
        name: what others see.
    """

    outside: str
    login: str
    name: str


class Provider:
    """A provider, as its configuration says under ISSUER/.well-known/openid-configuration.

    Args:
        issuer: its address, https but on this machine.
        client: id under which this server is known there.
        secret: that goes with it.

    Raises:
        InputError: the optional packages are missing, or the address cannot be one.
    """

    def __init__(self, issuer: str, client: str, secret: str):
        try:
            from authlib.integrations.httpx_client import OAuth2Client
        except ImportError as error:
            raise InputError(
                f"OpenID Connect needs the package {error.name}",
                column="--oidc",
                expected="pip install 'teachframe[oidc]'",
            ) from None
        parts = urlsplit(issuer)
        here = parts.hostname in ("127.0.0.1", "::1", "localhost")
        if not parts.hostname or parts.scheme not in (("http", "https") if here else ("https",)):
            raise InputError(f"{issuer!r} is no provider", column="--oidc", expected="https://HOST/…")
        self.issuer, self._client, self._secret, self._kind = issuer.rstrip("/"), client, secret, OAuth2Client
        self.name = parts.hostname
        self._known: dict[str, Any] = {}
        self._lock = threading.Lock()

    def ask(self, back: str) -> tuple[str, Asked]:
        """Where to send somebody who wants in, and what to remember until he is back at the address `back`.

        Raises:
            StorageError: the provider does not answer.
        """
        asked = Asked(*(secrets.token_urlsafe(32) for _ in range(3)))
        with self._session(back) as session:
            url, _ = session.create_authorization_url(
                self._configuration()["authorization_endpoint"],
                state=asked.state,
                nonce=asked.nonce,
                code_verifier=asked.verifier,
            )
        return url, asked

    def answer(self, asked: Asked, state: str, code: str, back: str) -> Vouched:
        """Who came back.

        Args:
            asked: what was remembered in his browser.
            state, code: what he brings.
            back: the address he was sent back to.

        Raises:
            PersonRefusedError: he does not bring what he was sent for, or the provider does not vouch for him.
            StorageError: the provider does not answer.
        """
        from authlib.integrations.base_client import OAuthError
        from authlib.oidc.core import CodeIDToken
        from joserfc import jwt
        from joserfc.errors import JoseError
        from joserfc.jwk import KeySet

        if not secrets.compare_digest(asked.state.encode(), state.encode()) or not code:
            raise refused("outside")
        configuration = self._configuration()
        try:
            with self._session(back) as session:
                token = self._got(
                    lambda: session.fetch_token(
                        configuration["token_endpoint"], code=code, code_verifier=asked.verifier
                    )
                )
            keys = self._read(configuration["jwks_uri"])
            signed = jwt.decode(token["id_token"], KeySet.import_key_set(keys), algorithms=_SIGNED)
            options = {
                "iss": {"essential": True, "value": self.issuer},
                "aud": {"essential": True, "value": self._client},
            }
            params = {
                "nonce": asked.nonce,
                "client_id": self._client,
                "access_token": token.get("access_token"),
            }
            claims = CodeIDToken(signed.claims, signed.header, options, params)
            claims.validate(leeway=_CLOCKS)
            outside = f"{self.issuer}|{claims['sub']}"
        except (OAuthError, JoseError, ValueError, KeyError, TypeError):
            raise refused("outside") from None
        if len(outside) > _LONGEST:
            raise refused("outside")
        login = str(claims.get("preferred_username") or claims.get("email") or claims["sub"])
        return Vouched(outside, login, str(claims.get("name") or login))

    def _session(self, back: str) -> Any:
        return self._kind(
            self._client,
            self._secret,
            scope="openid profile email",
            redirect_uri=back,
            code_challenge_method="S256",
            timeout=_ANSWER,
        )

    def _configuration(self) -> dict[str, Any]:
        with self._lock:
            if not self._known:
                address = f"{self.issuer}/.well-known/openid-configuration"
                known = self._read(address)
                needed = {"issuer", "authorization_endpoint", "token_endpoint", "jwks_uri"}
                if not isinstance(known, dict) or needed - known.keys() or known["issuer"] != self.issuer:
                    raise StorageError(f"{self.name} has no configuration of OpenID Connect")
                self._known = known
            return self._known

    def _read(self, address: str) -> Any:
        import httpx

        return self._got(lambda: httpx.get(address, timeout=_ANSWER).json())

    def _got(self, ask: Any) -> Any:
        import httpx

        try:
            return ask()
        except (httpx.HTTPError, ValueError):
            raise StorageError(
                f"{self.name} does not answer; log in by name and password, or later"
            ) from None
