"""Types that JSON and TOML are read into, learnt while one thread is alone.

msgspec takes a type apart when it first meets it. Where two threads meet a new one at the same moment (two persons open
a fresh server's page) the process ends with a segmentation fault. So every module that reads into a type of its own
says so while it is imported, which Python lets one thread do at a time.
"""

from __future__ import annotations

from typing import Any

import msgspec


def learnt(kind: Any) -> msgspec.json.Decoder[Any]:
    """What reads JSON into a type; any thread may use it, and `msgspec.convert` into that type, from then on."""
    return msgspec.json.Decoder(kind)
