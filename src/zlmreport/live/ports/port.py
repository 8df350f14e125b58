"""Opens any port of pyserial; keys of all instruments: port, sign, scale, timeout, rate; what went wrong."""

from __future__ import annotations

import errno
import os
import re
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from types import ModuleType
from typing import Annotated, Any, Literal, NoReturn
from urllib.parse import urlsplit

from pydantic import BeforeValidator, Field

from zlmreport.errors import AccessError, InputError, Place
from zlmreport.files import Closable
from zlmreport.job.types import Options
from zlmreport.live.ports.reading import LiveReading

#: How much of what a wrong device sends a message shows.
_SHOWN_BYTES = 24


@dataclass(frozen=True, slots=True)
class Framing:
    """How bytes travel on a line; of no matter on a network or a USB port that only looks like a line.

    Attributes
    ----------
    baud_rate
        Bits a second.
    bits, parity, stop_bits
        Of a byte: data bits; ``N`` none, ``E`` even, ``O`` odd; stop bits.
    xon_xoff
        Whether the sender is held by DC3 and released by DC1.
    """

    baud_rate: int = 9600
    bits: Literal[7, 8] = 8
    parity: Literal["N", "E", "O"] = "N"
    stop_bits: Literal[1, 2] = 1
    xon_xoff: bool = False

    def __str__(self) -> str:
        """Return how it is said among those who wire it: ``9600 7E2``."""
        return f"{self.baud_rate} {self.bits}{self.parity}{self.stop_bits}"


class Port(Closable):
    """An open port.

    Parameters
    ----------
    name
        Any name or address that pyserial knows.
    framing
        How bytes travel on it.
    timeout
        How long a write may take, s.

    Raises
    ------
    AccessError
        If it cannot be opened; here and in every method, with what the operator can do.
    InputError
        If it is no name of a port.
    """

    def __init__(self, name: str, framing: Framing, timeout: float) -> None:
        self.place = Place(name)
        self.empty_at = time.monotonic()  #: When it was looked at last and had nothing, s.
        self._lock = threading.Lock()
        self._is_closed = False
        self._serial = _load_pyserial(self.place)
        try:
            self._port: Any = self._serial.serial_for_url(
                name,
                baudrate=framing.baud_rate,
                bytesize=framing.bits,
                parity=framing.parity,
                stopbits=framing.stop_bits,
                xonxoff=framing.xon_xoff,
                timeout=0.0,
                write_timeout=timeout,
                **_ask_to_be_alone(name),
            )
            _let_parity_count(self._port, framing)
        except ValueError as error:
            raise InputError.at(
                self.place, f"is no port ({error}); write /dev/ttyUSB0, COM3 or socket://host:number"
            ) from error
        except OSError as error:  # pyserial's own errors among them
            raise AccessError.at(self.place, _say_why_not_opened(name, error)) from error

    def close(self) -> None:
        """Close the port; it may be closed already. Who reads it in another thread is told so."""
        with self._lock:
            self._is_closed = True
            network = getattr(self._port, "_socket", None)
            self._port.close()
            if network is not None:  # pyserial leaves one open whose other end has gone
                network.close()

    def read(self, wait: float) -> bytes:
        """Return what has arrived; wait for the first byte, but no longer than `wait`, s."""
        until = time.monotonic() + wait
        try:
            while True:
                looked = time.monotonic()
                with self._lock:
                    if self._is_closed:
                        self.fail("is closed")
                    data: bytes = self._port.read(4096)
                if data:
                    return data
                self.empty_at = looked
                if looked >= until:
                    return data
                time.sleep(_PAUSE)
        except OSError as error:
            self._is_gone(error)

    def write(self, data: bytes) -> None:
        """Send bytes."""
        try:
            self._port.write(data)
        except OSError as error:
            self._is_gone(error)

    def drop_input(self) -> None:
        """Forget what has arrived so far: it is of the time before."""
        while self.read(0.0):
            pass

    def fail(self, message: str) -> NoReturn:
        """Raise an `AccessError` at this port."""
        raise AccessError.at(self.place, message)

    def _is_gone(self, error: OSError) -> NoReturn:
        raise AccessError.at(
            self.place,
            f"the instrument is gone ({_write_in_one_line(error)}); look at its cable and its power, "
            "then start again",
        ) from error


#: Between two looks at a port, s: far below what an operator or a dwell notices.
_PAUSE = 0.002


def show_beginning(data: bytes) -> str:
    """Return the beginning of what arrived, as a message shows it."""
    dots = "…" if len(data) > _SHOWN_BYTES else ""
    return repr(data[:_SHOWN_BYTES])[1:] + dots


def _load_pyserial(place: Place) -> ModuleType:
    try:
        import serial  # noqa: PLC0415 - only who has an instrument needs it
    except ImportError as error:
        raise AccessError.at(
            place, "live instruments need pyserial: pip install 'zlmreport[capture]'"
        ) from error
    module: ModuleType = serial
    return module


def _ask_to_be_alone(name: str) -> dict[str, bool]:
    """Return what keeps other programs away from a port while it is open, where there is such a thing."""
    return {"exclusive": True} if os.name == "posix" and "://" not in name else {}


def _let_parity_count(port: Any, framing: Framing) -> None:
    """Let a byte of wrong parity arrive as NUL, which no instrument sends; pyserial would hand it over."""
    if framing.parity == "N" or os.name != "posix" or not hasattr(port, "fd"):
        return
    import termios  # noqa: PLC0415 - there is none on other systems

    try:
        settings = termios.tcgetattr(port.fd)
        settings[0] = settings[0] & ~(termios.IGNPAR | termios.PARMRK) | termios.INPCK
        termios.tcsetattr(port.fd, termios.TCSANOW, settings)
    except termios.error as error:
        raise OSError(*error.args) from error


def _say_why_not_opened(name: str, error: OSError) -> str:
    """Say why a port does not open, and what the operator can do."""
    number = error.errno
    if number is None and isinstance(error.__cause__ or error.__context__, OSError):
        number = (error.__cause__ or error.__context__).errno  # type: ignore[union-attr]
    text = _write_in_one_line(error)
    if "://" in name:
        return f"cannot be reached ({text}); look at the address, the network and the instrument's power"
    if number == errno.ENOENT or "FileNotFoundError" in text:
        return f"there is no such port; {_list_ports()}"
    if number in {errno.EACCES, errno.EPERM} or "PermissionError" in text:
        return (
            "may not be opened by you, or another program has it open; on Linux the group dialout may: "
            "sudo usermod -aG dialout $USER, then log in again"
        )
    if number in {errno.EBUSY, errno.EAGAIN} or "exclusively lock" in text:
        return "is in use by another program; close that first"
    return f"cannot be opened ({text})"


def _list_ports() -> str:
    from serial.tools import list_ports  # noqa: PLC0415 - only for this message

    found = sorted(str(port.device) for port in list_ports.comports())
    if not found:
        return "no serial port was found: plug the instrument in and switch it on"
    return f"there are: {', '.join(found)}"


def _write_in_one_line(error: OSError) -> str:
    return " ".join(str(error).split())[:200]


#: A host and a number, and nothing that says that they are on a network.
_HOST_ALONE = re.compile(r"[\w.-]+:\d+", re.ASCII)


def _check_port_is_named(value: object) -> object:
    if not value:
        raise ValueError("the name of a port is expected: /dev/ttyUSB0, COM3, socket://192.168.1.20:9090")
    if not isinstance(value, str):
        return value
    kind = value.partition("://")[0].casefold()
    if kind == "spy":
        raise ValueError(f"{value!r} writes what passes into a file; name the port itself")
    if _HOST_ALONE.fullmatch(value) or (kind == "socket" and not _has_host_and_number(value)):
        raise ValueError(
            f"{value!r} does not lead to an instrument on a network; a host and a number from 1 to 65535 are "
            "expected: socket://192.168.1.20:9090"
        )
    return value


def _has_host_and_number(address: str) -> bool:
    """Tell whether an address has both: pyserial has no words for one that has not."""
    parts = urlsplit(address)
    try:
        return bool(parts.hostname and parts.port)
    except ValueError:
        return False


class PortOptions(Options):
    """Where an instrument is, and which way its readings count."""

    port: Annotated[str, BeforeValidator(_check_port_is_named)] = Field(
        description="Port, as pyserial names it: /dev/ttyUSB0, COM3, socket://192.168.1.20:9090."
    )
    sign: Literal["+", "-"] = Field(
        "+", description="'-' where the instrument counts down while the axis moves up."
    )
    scale: Annotated[float, Field(gt=0, allow_inf_nan=False)] = Field(
        1.0, description="Factor on every reading: 0.5 for optics that double the path."
    )
    timeout: Annotated[float, Field(gt=0, le=60)] = Field(
        2.0, description="How long the instrument may be silent, s, before it counts as gone."
    )

    @property
    def factor(self) -> float:
        """Scale and sign in one number."""
        return -self.scale if self.sign == "-" else self.scale


class PolledOptions(PortOptions):
    """The same of an instrument that answers questions."""

    rate: Annotated[float, Field(gt=0, le=1000)] = Field(
        10.0, description="How often the instrument is asked, 1/s; less often where it is slower."
    )


class LiveConnection(Closable):
    """A connection made of its parts; it closes the port when it is left.

    Parameters
    ----------
    port
        Where the instrument is.
    readings
        Begins to read, and yields without end.
    zero
        Lets the instrument begin to count from here; None if it cannot be told to.
    """

    def __init__(
        self,
        port: Port,
        readings: Callable[[], Iterator[LiveReading]],
        zero: Callable[[], None] | None = None,
    ) -> None:
        self._port = port
        self._readings = readings
        self._zero = zero
        self.can_zero = zero is not None

    def close(self) -> None:
        """Close the port."""
        self._port.close()

    def readings(self) -> Iterator[LiveReading]:
        """Yield readings as they arrive, without end."""
        return self._readings()

    def zero(self) -> None:
        """Let the instrument count from here."""
        if self._zero is None:
            self._port.fail(
                "this instrument cannot be set to zero from here; press its key, or leave it as it is"
            )
        self._zero()
