"""A plugin of a live instrument that tells a story: so a capture of minutes takes no time."""

from __future__ import annotations

import os
import select
import sys
import time
from collections.abc import Iterable, Iterator
from typing import Self

from pydantic import Field

from live.capture.moves import Axis
from processes import PATIENCE
from zlmreport.plugin import AccessError, Options, Place, hookimpl, same_in_all_languages as same
from zlmreport.plugin.instrument import Emulator, Fault, LiveReading, Scene
from zlmreport.plugin.protocols import Instrument

_LOST = {"faults": Fault.BEAM_LOST, "value": float("nan"), "message": "the beam is broken"}


class ScriptOptions(Options):
    """What the axis does."""

    port: str = Field("none", description="Of no matter.")
    moves: str = Field(
        description="Positions, mm; 't25' turns round there, 'press:r_2' types, and words are troubles."
    )


class Story:
    """A connection; each call of `readings` begins at −5 mm, with the next chapter, parted by ``wait``."""

    can_zero = False

    def __init__(self, moves: str) -> None:
        self._chapters = iter(moves.split("wait"))
        self._axis = Axis(time=time.monotonic(), error={20.0: 0.003})

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        pass

    def zero(self) -> None:
        """Do nothing."""

    def readings(self) -> Iterator[LiveReading]:
        """Yield the readings of a chapter; an end of the story is an instrument that has gone."""
        self._axis.unseen(1.0, position=-5.0)
        moves = next(self._chapters).split()
        self._axis.step = 0.5 if "slow" in moves else 0.01
        yield from self._axis.stand(20.0 if "slow" in moves else 2.0)
        for move in moves:
            if move == "lost":
                yield from self._axis.stand(1.2, **_LOST)
            elif move == "interrupt":
                raise KeyboardInterrupt
            elif move == "silent":
                self._axis.unseen(100.0)
                yield from self._axis.stand(0.1)
            elif move.startswith("press:"):
                os.write(int(os.environ["KEYBOARD"]), f"{move[6:].replace('_', ' ')}\n".encode())
                select.select([sys.stdin], [], [], PATIENCE)
                yield from self._axis.stand(0.3)
            elif move.startswith("t"):
                yield from self._axis.turn(float(move[1:]))
            else:
                yield from self._axis.go(float(move))
        raise AccessError.at(Place("the port"), "the instrument is gone; look at its cable")


class Scripted:
    """A live instrument without a port."""

    identifier = "scripted"
    title = same("Scripted instrument")
    options: type[Options] = ScriptOptions

    def open(self, options: ScriptOptions) -> Story:
        """Begin a story."""
        return Story(options.moves)

    def emulator(self, scene: Scene) -> Emulator:
        """Refuse: the story is the emulation."""
        raise NotImplementedError


@hookimpl
def zlmreport_instruments() -> Iterable[Instrument]:
    """Return the instrument."""
    return [Scripted()]
