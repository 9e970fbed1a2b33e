"""How browsers come to the server: under which names, by TLS of its own or through a proxy."""

from __future__ import annotations

import re
import ssl
from dataclasses import dataclass
from pathlib import Path

from app.errors import InputError

_PREFIX = re.compile(r"(/[A-Za-z0-9_.-]+)*\Z")
_NAME = re.compile(r"[A-Za-z0-9]([A-Za-z0-9.-]{0,251}[A-Za-z0-9])?\Z")


@dataclass(frozen=True)
class Way:
    """How browsers come.

    Args:
        names: host names that are answered besides the address.
        prefix: path under which everything stands, such as /teachframe; empty for none.
        certificate, key: PEM files of a TLS certificate with its chain and of its key; None serves without.
        proxy: takes a browser's address and TLS from the headers of a proxy on this machine.
    """

    names: tuple[str, ...] = ()
    prefix: str = ""
    certificate: Path | None = None
    key: Path | None = None
    proxy: bool = False

    def checked(self) -> Way:
        """The same; raises InputError where something cannot be."""
        if (self.certificate is None) != (self.key is None):
            raise InputError("a certificate and its key belong together", column="--tls-cert, --tls-key")
        if self.certificate is not None:
            try:
                ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER).load_cert_chain(self.certificate, self.key)
            except OSError as error:  # SSLError is one, too
                raise InputError(
                    f"no certificate with its key ({error.strerror or 'not readable'})",
                    file=self.certificate,
                    column="--tls-cert, --tls-key",
                    expected="two PEM files",
                ) from None
        if not _PREFIX.match(self.prefix):
            raise InputError(f"{self.prefix!r} is no path", column="--prefix", expected="such as /teachframe")
        for name in self.names:
            if not _NAME.match(name):
                raise InputError(
                    f"{name!r} is no host name", column="--name", expected="such as class.example.org"
                )
        return self
