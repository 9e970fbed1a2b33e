"""What somebody sends from the browser: refused where it is too large, put where its name cannot lead out of."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from app.pendant.client import Pendant


def put(
    pendant: Pendant,
    folder: Path | str,
    name: str,
    content: bytes,
    *,
    otherwise: str,
    most: int,
    refusal: str = "message.too_large",
) -> Path | None:
    """Writes a file that was sent into `folder`; None where it is too large, which the operator is told.

    Args:
        name: as the browser gives it; only its last part counts.
        otherwise: name of a file that has none.
        most: bytes.
        refusal: key of the text that refuses.
    """
    if len(content) > most:
        pendant.say("warning", pendant.t(refusal, name=name))
        return None
    path = Path(folder) / (Path(name).name or otherwise)
    path.write_bytes(content)
    return path
