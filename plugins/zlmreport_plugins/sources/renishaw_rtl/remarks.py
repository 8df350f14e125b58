"""What a test file says beside its deviations: header, user text, equipment, environment."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from zlmreport.plugin import Problem, Words, parse_number, same_in_all_languages
from zlmreport_plugins.sources.renishaw_rtl.sections import Entry, Section

#: Of a text in a file that is printed as a remark.
_LONGEST = 200
#: What is recorded for a sensor that is not there.
_ABSENT = -10.0

_TEMPERATURES = {None: "°C", "0": "°C"}
_RECORDED: tuple[tuple[str, Words, Mapping[str | None, str]], ...] = (
    ("airtemp", Words(en="Air temperature", de="Lufttemperatur"), _TEMPERATURES),
    ("airpress", Words(en="Air pressure", de="Luftdruck"), {"1": "kPa"}),
    ("airhumid", Words(en="Relative humidity", de="Relative Luftfeuchte"), {None: "%"}),
    ("mattemp", Words(en="Material temperature", de="Materialtemperatur"), _TEMPERATURES),
    ("envfactor", Words(en="Environmental factor", de="Umgebungsfaktor"), {}),
    (
        "expcoeff",
        Words(en="Expansion coefficient", de="Ausdehnungskoeffizient"),
        {None: "ppm/°C", "0": "ppm/°C"},
    ),
)
#: Says nothing of the conditions.
_NOT_SAID = frozenset({"finaldata"})

#: Sections whose lines are kept as they are.
_TEXTS = {
    "HEADER": Words(en="Header of the file: {text}.", de="Kopf der Datei: {text}."),
    "USER-TEXT": Words(en="User’s text in the file: {text}.", de="Text des Anwenders in der Datei: {text}."),
    "EQUIPMENT": Words(en="Equipment named in the file: {text}.", de="In der Datei genannte Geräte: {text}."),
}


def remarks(sections: Mapping[str, Section], problems: list[Problem]) -> Iterator[Words]:
    """Yield what the file says; a value that is no number is added to the problems."""
    for name, introduction in _TEXTS.items():
        if name in sections:
            lines = (" ".join(line.text.split())[:_LONGEST] for line in sections[name].lines)
            said = [line for line in lines if not line.endswith(":")]
            if said:
                yield introduction.given(text="; ".join(said))
    if "ENVIRONMENT" in sections:
        for entry in sections["ENVIRONMENT"].entries():
            try:
                remark = _recorded(entry)
            except ValueError as error:
                problems.append(Problem(entry.line.place, f"{entry.name}: {error}"))
            else:
                if remark:
                    yield remark


def _recorded(entry: Entry) -> Words | None:
    """Return what was recorded at the start and at the end of the test; None if there was no sensor."""
    if entry.key in _NOT_SAID:
        return None
    kind = entry.key.rstrip("0123456789")
    quantity, units = next(
        ((words, units) for key, words, units in _RECORDED if key == kind),
        (same_in_all_languages(entry.name), None),
    )
    if units is None:
        return Words(en="{quantity}: {text}.", de="{quantity}: {text}.").given(
            quantity=quantity, text=entry.value[:_LONGEST]
        )
    values = [parse_number(word) for word in entry.value.split()[:2]]
    if len(values) < 2 or values == [_ABSENT, _ABSENT]:
        return None
    code = next(iter(entry.value.split()[2:]), None)
    unit = units.get(code, f"(unit {code})" if code else "")
    return Words(
        en="{quantity}{number}: {start}{unit} at the start, {end}{unit} at the end of the test.",
        de="{quantity}{number}: {start}{unit} zu Beginn, {end}{unit} am Ende der Messung.",
    ).given(
        quantity=quantity,
        number=f" {number}" if (number := entry.key[len(kind) :]) else "",
        start=values[0],
        end=values[1],
        unit=f" {unit}" if unit else "",
    )
