"""A line that drops, garbles, doubles and delays what is sent on it; each fault is counted."""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Sequence
from enum import StrEnum
from random import Random


class LineFault(StrEnum):
    """What happens to a line of text, or to an answer."""

    DROPPED = "dropped"
    GARBLED = "garbled"
    DOUBLED = "doubled"
    DELAYED = "delayed"


class FaultyLine:
    """Stands between an emulated instrument and the port.

    Attributes
    ----------
    faults
        How many of each kind there were.

    Parameters
    ----------
    share
        Of the lines that something happens to.
    delay
        How long a delayed line takes, s: until then others overtake it.
    kinds
        The faults that the line has.
    has_parity
        Whether a byte that is another arrives as NUL, as it does where its parity is checked.
    """

    def __init__(
        self,
        share: float,
        delay: float,
        kinds: Sequence[LineFault] = tuple(LineFault),
        *,
        has_parity: bool = False,
        seed: int = 1,
    ) -> None:
        self.faults: Counter[LineFault] = Counter()
        self._share = share
        self._delay = delay
        self._kinds = kinds
        self._has_parity = has_parity
        self._random = Random(seed)
        self._late: deque[tuple[float, bytes]] = deque()

    def __call__(self, data: bytes, now: float) -> bytes:
        """Return what arrives when bytes are sent that hold whole lines."""
        arrives = b"".join(self._fate(line, now) for line in data.splitlines(keepends=True))
        while self._late and self._late[0][0] <= now:
            arrives += self._late.popleft()[1]
        return arrives

    def _fate(self, line: bytes, now: float) -> bytes:
        if self._random.random() >= self._share:
            return line
        fault = self._random.choice(self._kinds)
        self.faults[fault] += 1
        match fault:
            case LineFault.DROPPED:
                return b""
            case LineFault.GARBLED:
                return self._garbled(line)
            case LineFault.DOUBLED:
                return line + line
            case LineFault.DELAYED:
                self._late.append((now + self._delay, line))
                return b""

    def _garbled(self, line: bytes) -> bytes:
        """Return a line in which some of the bytes are others, or lost, the end of the line among them."""
        spoilt = bytearray(line)
        for _ in range(self._random.randint(1, 3)):
            if not spoilt:
                break
            place = self._random.randrange(len(spoilt))
            match self._random.randrange(3):
                case 0:
                    spoilt[place] = self._other(spoilt[place] ^ 1 << self._random.randrange(7))
                case 1:
                    spoilt[place] = self._other(self._random.choice(b"0123456789 -"))
                case 2:
                    del spoilt[place : place + self._random.randint(1, 4)]
        return bytes(spoilt)

    def _other(self, byte: int) -> int:
        return 0 if self._has_parity else byte
