"""What a log-in's cookie holds: the browser's secret, and a signature that only this server's key makes."""

from __future__ import annotations

import hmac


def signed(key: bytes, secret: str) -> str:
    """The cookie's value."""
    return f"{secret}.{_signature(key, secret)}"


def secret_of(key: bytes, cookie: str) -> str | None:
    """The browser's secret, where its cookie was signed with the key; None for any other text."""
    secret, _, signature = cookie.rpartition(".")
    good = _signature(key, secret).encode()
    fits = hmac.compare_digest(good, signature.encode("utf-8", "replace"))
    return secret if secret and fits else None


def _signature(key: bytes, secret: str) -> str:
    return hmac.new(key, f"cookie {secret}".encode("utf-8", "surrogatepass"), "sha256").hexdigest()
