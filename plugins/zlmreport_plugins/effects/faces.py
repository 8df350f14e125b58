"""Which face of a gauge a reading touched."""

from __future__ import annotations

#: A logged column: +1 where a probe touched the gauge in the positive direction, −1 in the negative.
FACE = "face"
