"""Opinions and interpretations: in a section of their own, each with its basis and who states it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from zlmreport.certificate.document import Column, Notice, RowGroup, Section, Table
from zlmreport.language import Words
from zlmreport.presenting.writer import NOTHING, Writer

if TYPE_CHECKING:
    from zlmreport.job.document_keys import Person
    from zlmreport.job.keys import JobKeys

#: Above every opinion of a document.
OPINION = Words(
    en="Opinion and interpretation (ISO/IEC 17025:2017, 7.8.7), not a result of the calibration",
    de="Meinung und Interpretation (ISO/IEC 17025:2017, 7.8.7), kein Ergebnis der Kalibrierung",
)
_TITLE = Words(en="Opinions and interpretations", de="Meinungen und Interpretationen")
_RESTS = Words(
    en="Each is stated by an authorised person and rests on what is named as its basis.",
    de="Jede stammt von einer dazu befugten Person und beruht auf dem, was als Grundlage genannt ist.",
)


def section(keys: JobKeys, writer: Writer) -> Iterator[Section]:
    """Yield the section of a job's opinions, if it states any."""
    if keys.opinions:
        apart = Notice(writer.say(OPINION), (writer.say(_RESTS),))
        yield Section("opinions", writer.say(_TITLE), (apart, _table(keys, writer)), new_page=True)


def _table(keys: JobKeys, writer: Writer) -> Table:
    columns = tuple(
        Column(writer.say(heading))
        for heading in (
            Words(en="Opinion", de="Meinung"),
            Words(en="Basis", de="Grundlage"),
            Words(en="Stated by", de="Geäußert von"),
        )
    )
    rows = tuple(
        (
            opinion.statement,
            opinion.basis,
            in_a_line(person) if (person := opinion.by or keys.certificate.authorised_by) else NOTHING,
        )
        for opinion in keys.opinions
    )
    return Table(writer.say(_TITLE), columns, (RowGroup(rows),))


def in_a_line(person: Person) -> str:
    """Return a person's name and function."""
    return ", ".join(filter(None, (person.name, person.function)))
