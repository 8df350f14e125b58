"""An effect that two plugins provide: it stands in listings, and no test of it is made."""

from __future__ import annotations

from typing import Any, Self

from zlmreport.boundary.guard import Guarded
from zlmreport.language import Words

_WHY = Words(en="two plugins provide it", de="zwei Plug-ins stellen ihn bereit")


class _Doubtful(Guarded):
    """An effect of which nobody knows which is meant."""

    def untestable(self, _design: object) -> Words:
        """Return why no test of it is made."""
        return _WHY

    def forms(self) -> tuple[Self, ...]:
        """Return itself: no form of it is tried."""
        return (self,)


def doubtful(effect: Any) -> Any:
    """Return an effect as one that cannot be tested."""
    return effect.doubted(_Doubtful)
