"""Where the work was done (ISO/IEC 17025:2017, 7.8.2.1 c)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from zlmreport.job.document_keys import Location
from zlmreport.language import Words, same

if TYPE_CHECKING:
    from zlmreport.job.keys import JobKeys


@dataclass(frozen=True, slots=True)
class Place:
    """A place of work.

    Attributes
    ----------
    kind
        ``laboratory``, ``customer``, ``laboratory branch``, ``customer branch`` or ``other``.
    address
        In one line or several; empty where the job states none.
    words
        What the page says: whose place it is, and its address.
    keys
        The job keys that state it.
    """

    kind: str
    address: str
    words: Words
    keys: tuple[str, ...]


_KINDS = {
    "laboratory": Words(en="in the laboratory", de="im Laboratorium"),
    "customer": Words(en="at the customer's", de="beim Auftraggeber"),
    "laboratory branch": Words(
        en="at a branch of the laboratory", de="in einer Zweigstelle des Laboratoriums"
    ),
    "customer branch": Words(en="at a branch of the customer", de="in einer Zweigstelle des Auftraggebers"),
}
_AT = Words(en="{kind}: {address}", de="{kind}: {address}")
_WHERE_IT_STANDS = Words(
    en="where the machine stands: {location}", de="am Aufstellort der Maschine: {location}"
)
_ASSUMED = Words(
    en="at the customer's: {address} (no other place is stated)",
    de="beim Auftraggeber: {address} (kein anderer Ort angegeben)",
)


def place_of_work(keys: JobKeys) -> Place | None:
    """Return where the work was done; None where the job gives no hint of it.

    A machine is calibrated where it stands. A job that does not say where the work was done is therefore
    taken to mean the machine's location, or else, on a certificate, the customer's address; the page says
    which.
    """
    match keys.location:
        case Location(kind=kind, address=address):
            return _of_kind(kind, address or _own_address(kind, keys))
        case str(location):
            return Place("other", location, same(_in_a_line(location)), ("location",))
    if keys.machine.location:
        words = _WHERE_IT_STANDS.given(location=keys.machine.location)
        return Place("other", keys.machine.location, words, ("machine.location",))
    if keys.certificate.kind == "certificate" and keys.customer and keys.customer.address:
        address = keys.customer.address
        return Place("customer", address, _ASSUMED.given(address=_in_a_line(address)), ("customer.address",))
    return None


def _of_kind(kind: str, address: str) -> Place:
    words = _KINDS.get(kind)
    if words is None:
        words = same(_in_a_line(address))
    elif address:
        words = _AT.given(kind=words, address=_in_a_line(address))
    return Place(kind, address, words, ("location",))


def _own_address(kind: str, keys: JobKeys) -> str:
    party = keys.laboratory if kind == "laboratory" else keys.customer
    return party.address or "" if party else ""


def _in_a_line(address: str) -> str:
    return ", ".join(line.strip().removesuffix(",") for line in address.splitlines() if line.strip())
