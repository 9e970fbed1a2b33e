"""What somebody who only looks on gets of a session: its scene without a handle, its figures, nothing to say."""

from __future__ import annotations

from app.scene.looked_on import without_handle

__all__ = ["without_handle"]
