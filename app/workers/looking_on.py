"""What somebody who only looks on gets of a session: its scene without a handle, in his own colours, its figures;
nothing to say."""

from __future__ import annotations

from app.scene.looked_on import for_onlooker

__all__ = ["for_onlooker"]
