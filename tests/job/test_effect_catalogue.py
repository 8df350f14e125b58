"""A catalogue of effects is read like a job: every mistake at its line and column."""

from __future__ import annotations

import pytest

from refusals import refusal, refused
from zlmreport.job.effect_catalogue import read_catalogue, read_measurements
from zlmreport.job.formula_keys import FormulaKeys
from zlmreport.plugin import InputError, Language

_SOUND = """schema: zlmreport/effects/1
measurements:
  fine-run: {en: a fine run, de: ein Feinlauf}
effects:
  - name: rack
    title: {en: Rack, de: Zahnstange}
    formula: reset*(P/segment - floor(P/segment))
    parameters:
      reset: {unit: um, range: [-100, 100]}
      segment: {unit: mm, range: [100, 1000], step: 20}
    needs: {axis: linear, targets: 8}
    taken_for: {periodic: fine-run, offset: {en: a ring, de: ein Ring}}
"""


def _read(text: str) -> tuple[FormulaKeys, ...]:
    files = {
        "shared.yaml": b"schema: zlmreport/effects/1\nmeasurements: {ring: {en: a ring, de: ein Ring}}\n"
    }

    def beside(name: str) -> bytes:
        if name not in files:
            raise FileNotFoundError(name)
        return files[name]

    return read_catalogue(text.encode(), "rack.yaml", beside)


def test_entry_is_what_the_file_says() -> None:
    (rack,) = _read(_SOUND)
    assert (rack.name, rack.needs.targets, rack.parameters["segment"].step) == ("rack", 8, 20.0)
    assert rack.title is not None
    assert rack.title.in_language(Language.GERMAN) == "Zahnstange"


def test_measurement_is_written_once_and_named_by_entries() -> None:
    (rack,) = _read(_SOUND)
    told = {effect: words.in_language(Language.GERMAN) for effect, words in rack.taken_for.items()}
    assert told == {"periodic": "ein Feinlauf", "offset": "ein Ring"}


def test_measurements_may_stand_in_a_file_beside() -> None:
    shared = _SOUND.replace(
        "measurements:\n  fine-run: {en: a fine run, de: ein Feinlauf}", "measurements: shared.yaml"
    )
    (rack,) = _read(shared.replace("fine-run", "ring"))
    assert rack.taken_for["periodic"].in_language(Language.ENGLISH) == "a ring"


def test_measurements_are_read_by_themselves_too() -> None:
    found = read_measurements(_SOUND.encode(), "rack.yaml", lambda _: b"")
    assert found["fine-run"].in_language(Language.GERMAN) == "ein Feinlauf"


@pytest.mark.parametrize(
    ("right", "wrong", "sentence"),
    [
        ("effects/1", "effects/2", "rack.yaml:1:9: schema: 'zlmreport/effects/2' is unknown; did you mean"),
        (
            "{en: Rack, de: Zahnstange}",
            "{de: Zahnstange}",
            "rack.yaml:6:5: effects.rack.title: a text is {en: …, de: …}; en is missing",
        ),
        ("name: rack", "name: Rack", "rack.yaml:5:11: effects.Rack.name: 'Rack' is not text of the form"),
        (
            "    formula:",
            "    formular:",
            "rack.yaml:7:5: unknown key 'formular' in effects.rack; did you mean 'formula'?",
        ),
        (
            "floor(P/segment)",
            "floor(P)",
            "rack.yaml:7:14: effects.rack.formula: floor takes a number, not travel",
        ),
        (
            "unit: um,",
            "unit: umm,",
            "rack.yaml:9:21: effects.rack.parameters.reset.unit: 'umm' is no unit of a parameter",
        ),
        (
            "de: Zahnstange",
            "dk: Tandstang",
            "rack.yaml:6:5: effects.rack.title: a text is {en: …, de: …}; dk is none of en, de, fr, it, es",
        ),
        (
            "periodic: fine-run",
            "periodic: fine-rum",
            "rack.yaml:12:27: there is no measurement 'fine-rum'; did you mean 'fine-run'?",
        ),
        (
            "axis: linear",
            "axis: linaer",
            "rack.yaml:11:19: effects.rack.needs.axis: 'linaer' is unknown; did you mean 'linear'?",
        ),
        (
            "{unit: mm, range: [100, 1000], step: 20}",
            "{unit: mm}",
            "rack.yaml:10:7: effects.rack.parameters.segment: segment is no factor of a whole term",
        ),
        (
            "measurements:\n  fine-run: {en: a fine run, de: ein Feinlauf}",
            "measurements: other.yaml",
            "rack.yaml:2:15: measurements: there is no file 'other.yaml' beside this one",
        ),
        (
            "effects:\n",
            "effects:\n  - ring\n",
            "rack.yaml:5:5: effects: 'ring' is no entry; each begins with '- name: …'",
        ),
        (
            "{unit: um, range: [-100, 100]}",
            "{unit: um, range: [-100, 100], possible: {least: 0, most: 5*rize, because: {en: so}}}",
            "rack.yaml:9:72: effects.rack.parameters.reset.possible.most: a bound depends on",
        ),
        (
            "{unit: um, range: [-100, 100]}",
            "{unit: um, range: [-100, 100], possible: {least: -5*(, most: 5, because: {en: so}}}",
            "rack.yaml:9:63: effects.rack.parameters.reset.possible.least: it ends where a number",
        ),
        (
            "step: 20}",
            "step: 20, stated: screw}",
            "rack.yaml:10:65: effects.rack.parameters.segment.stated: screw is no key of the axis; there are",
        ),
        (
            "    needs:",
            "    measurands: [position]\n    needs:",
            "rack.yaml:11:5: effects.rack.measurands: 'position' is nothing that is measured; did you mean",
        ),
    ],
)
def test_mistake_is_told_at_its_place(right: str, wrong: str, sentence: str) -> None:
    assert right in _SOUND
    assert sentence in refusal(_read, _SOUND.replace(right, wrong))


def test_every_mistake_is_told_at_once() -> None:
    spoilt = _SOUND.replace("unit: um,", "unit: umm,").replace("axis: linear", "axis: linaer")
    assert len(refused(_read, spoilt).problems) == 2


def test_entry_that_stands_there_twice_is_refused() -> None:
    entry = _SOUND.partition("effects:\n")[2]
    with pytest.raises(InputError, match=r"rack\.yaml:13:11: effects\.name: rack stands there twice"):
        _read(_SOUND + entry)
