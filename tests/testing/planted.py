# ruff: noqa: ISC004, E501 - pieces of text that stand as they do in a skeleton
"""Mistakes that authors of plugins make, planted into what ``zlmreport new`` writes.

Each is a change of text in the skeleton (or in its test, where a mistake needs something to be made in), the
check of the kit that must find it, and what that check says of it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

#: What is replaced by what, in one file.
Changes: TypeAlias = tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class Planted:
    kind: str
    mistake: str
    check: str
    sentence: str
    module: Changes = ()
    test: Changes = ()
    data: Changes = ()

    def __str__(self) -> str:
        return f"{self.kind}: {self.mistake}"


_D = "range_over_positions(statistics.mean_positive, statistics.mean_positive)"
_R = (
    (
        "    position_quantities: tuple",
        '    quantities += (Quantity("R", "R", title, QuantityGroup.RANDOM, "max(4s + |B|)", title),)\n'
        "    position_quantities: tuple",
    ),
    (
        '"S": largest_over_positions(4 * statistics.s_positive),',
        '"S": largest_over_positions(4 * statistics.s_positive),\n'
        '                "R": largest_over_positions(4 * statistics.s_positive),',
    ),
)
_KEY = (
    (
        "class MyPlugin:",
        "class MyOptions(Options):\n"
        '    least: int = Field(5, ge=1, description="So many runs are asked for.")\n\n\nclass MyPlugin:',
    ),
    ("import numpy as np\n", "import numpy as np\nfrom pydantic import Field\n"),
    ("options: type[Options] = Options", "options: type[Options] = MyOptions"),
)
_STANDARDS = (
    Planted(
        "standard",
        "k is 3 instead of 2",
        "gives_the_worked_values",
        "S is 8.48528 µm; the example has 5.65685 (a wrong factor",
        (("4 * statistics", "6 * statistics"),),
    ),
    Planted(
        "standard",
        "k is 1 instead of 2",
        "gives_the_worked_values",
        "S is 2.82843 µm; the example has 5.65685 (a wrong factor",
        (("4 * statistics", "2 * statistics"),),
    ),
    Planted(
        "standard",
        "R is without the reversal",
        "gives_the_worked_values",
        "R is 5.65685 µm; the example has 17.6569 (a wrong factor, or a term that was left out)",
        _R,
        (('"S": 5.656854', '"S": 5.656854, "R": 17.656854'),),
    ),
    Planted(
        "standard",
        "a parameter that no example has",
        "gives_the_worked_values",
        "they state no value, other than zero, of R",
        _R,
    ),
    Planted(
        "standard", "a job key is ignored", "every_key_matters", "job key 'least' is ignored: 11 or", _KEY
    ),
    Planted(
        "standard",
        "values are micrometres",
        "values_are_lengths_that_readings_have",
        "values are metres (radians), not micrometres",
        ((f'"D": {_D}', f'"D": 1e6 * {_D}'),),
    ),
    Planted(
        "standard",
        "zero stands for what is not defined",
        "nothing_gives_nothing",
        "expected NaN",
        ((f'"D": {_D}', f'"D": np.nan_to_num({_D})'),),
    ),
    Planted(
        "standard",
        "a stack of tests becomes one number",
        "gives_every_quantity",
        "of a stack of 3 tests at 7 positions has shape (); expected (3,)",
        (("largest_over_positions(4", "np.nanmax(4"),),
    ),
    Planted(
        "standard",
        "the first run alone counts",
        "order_of_runs_is_irrelevant",
        "D depends on the order of the runs",
        ((_D, _D.replace("statistics.mean_positive", "statistics.deviations[..., 0, :, 0]")),),
    ),
    Planted(
        "standard",
        "where the zero is counts",
        "scales_with_the_readings",
        "D does not double with the readings",
        ((f'"D": {_D}', f'"D": {_D} + 1e-6'),),
    ),
    Planted(
        "standard",
        "a test that falls short is refused",
        "requirements_never_refuse",
        "a test that falls short gives a finding, not an error",
        (
            (
                "return [number_of_runs",
                "assert measurements.runs.max() >= 5\n        return [number_of_runs",
            ),
        ),
    ),
    Planted(
        "standard",
        "a bracket is longer than its parameter",
        "brackets_are_as_long_as_their_parameter",
        "but the results table has",
        (('Bracket("D", float(mean[low])', 'Bracket("D", float(mean[low]) - 1'),),
    ),
)


def _effect(body: str) -> Changes:
    """Return the change that makes each effect of the catalogue one with another body."""
    return (
        (
            "    return effects_of_catalogue(",
            "    found = effects_of_catalogue(",
        ),
        (
            '"my_plugin.yaml")\n',
            '"my_plugin.yaml")\n    for each in found:\n        each.__class__ = _wrong(type(each))\n    return found\n',
        ),
        (
            "\n\n@hookimpl",
            "\n\ndef _wrong(sound):  # type: ignore\n    import numpy as np\n"
            "    from zlmreport.plugin.effect import Shape\n\n    class Wrong(sound):\n"
            f"        {body}\n\n    return Wrong\n\n\n@hookimpl",
        ),
    )


_EFFECTS = (
    Planted(
        "effect",
        "the search begins out of range",
        "grid_stays_in_range",
        "the grid of 'segment' leaves its range of 0.1 to 1 (SI) on every test",
        _effect("def grid(self, design): return 20 * sound.grid(self, design)"),
    ),
    Planted(
        "effect",
        "columns depend on the lowest reading",
        "rows_stand_alone",
        "(those above the lowest target stay)",
        _effect(
            "def columns(self, design, theta):\n"
            "            return sound.columns(self, design, theta) + design.position.min()"
        ),
    ),
    Planted(
        "effect",
        "it is taken for an effect that there is not",
        "names_what_it_is_taken_for",
        "no effect is called 'periodicity'; did you mean 'periodic'",
        data=(("periodic:", "periodicity:"),),
    ),
    Planted(
        "effect",
        "its shape is another",
        "shape_is_what_it_follows",
        "shape is TIME, and its columns follow position",
        _effect("shape = property(lambda self: Shape.TIME, lambda self, value: None)"),
    ),
    Planted(
        "effect",
        "it is never untestable",
        "cannot_be_tested_where_it_is_not_seen",
        "no readings could tell its parameters apart",
        _effect("def untestable(self, design): return None"),
    ),
    Planted(
        "effect",
        "its needs are forgotten",
        "cannot_be_tested_where_it_is_not_seen",
        "no readings could tell its parameters apart",
        data=(("    needs: {axis: linear, targets: 8}\n", ""),),
    ),
    Planted(
        "effect",
        "columns are micrometres",
        "plausible_sizes_are_metres",
        "columns and ranges are SI",
        _effect("def columns(self, design, theta): return 1e6 * sound.columns(self, design, theta)"),
    ),
    Planted(
        "effect",
        "a parameter changes nothing",
        "every_parameter_matters",
        "parameter 'segment' changes no column on any test",
        _effect(
            "def columns(self, design, theta): return sound.columns(self, design, np.full_like(theta, 0.3))"
        ),
    ),
)
_NAN = "                problems.append(Problem(place, str(error)))\n                number = math.nan\n"
_TELLS_LENGTH = (
    'problems.append(Problem(place, f"{len(numbers)} positions, and there are {len(targets)} targets"))'
)
_SOURCES = (
    Planted(
        "source",
        "a bad number becomes a missing reading",
        "no_number_is_guessed",
        "1 reading fewer without a word; a number that is none is an InputError with its place",
        ((_NAN, "                number = math.nan\n"), (" as error:", ":")),
    ),
    Planted(
        "source",
        "of a bad number the first digits count",
        "no_number_is_guessed",
        "other readings without a word",
        (("parse_number(word)", 'parse_number(word.partition("x")[0] or "0")'),),
    ),
    Planted(
        "source",
        "a short line is dropped",
        "no_short_line_is_dropped",
        "lost its last word, and that makes 3 readings fewer without a word",
        ((_TELLS_LENGTH, "continue"),),
    ),
    Planted(
        "source",
        "a rotary axis is read in millimetres",
        "follows_the_kind_of_axis",
        "read as of a rotary axis the targets are",
        (
            ("to_si = axis.position_unit.to_si", "to_si = MILLIMETRE.to_si"),
            ("import (\n    Approach,", "import (\n    MILLIMETRE,\n    Approach,"),
        ),
    ),
    Planted(
        "source",
        "directions are swapped",
        "reads_what_the_file_holds",
        "the file holds",
        (
            (
                '"UP": Approach.POSITIVE, "DOWN": Approach.NEGATIVE',
                '"DOWN": Approach.POSITIVE, "UP": Approach.NEGATIVE',
            ),
            ("targets[:: int(approach)]", "targets[:: -int(approach)]"),
        ),
    ),
    Planted(
        "source",
        "the sign is turned",
        "reads_what_the_file_holds",
        "is -0.2; the file holds 0.2",
        (("to_si(position - target)", "to_si(target - position)"),),
    ),
    Planted(
        "source",
        "every run is the first",
        "reads_a_measurement_set",
        "stands in line",
        (("runs[approach] += 1", "runs[approach] = 1"),),
    ),
    Planted(
        "source",
        "the file is not named",
        "names_its_files",
        "files do not name 'x-axis.log'",
        (("Provenance(self.identifier, (text.source,))", "Provenance(self.identifier, ())"),),
    ),
)
_NOTIFIERS = (
    Planted(
        "notifier",
        "it cuts at 200 characters",
        "tells_all_of_it_once",
        "did not arrive as it is",
        (("{message.text}", "{message.text[:200]}"),),
    ),
    Planted(
        "notifier",
        "it has one receiver",
        "tells_whom_its_keys_name",
        "receiver is 'the file' for other keys too",
        (("return str(options.file)", 'return "the file"'),),
    ),
    Planted(
        "notifier",
        "it tells always the same",
        "tells_whom_its_keys_name",
        "what somebody else is told arrives at",
        (("with options.file.open", 'with options.file.with_name("news.txt").open'),),
    ),
    Planted(
        "notifier",
        "letters are lost",
        "tells_all_of_it_once",
        "did not arrive as it is",
        (('encoding="utf-8"', 'encoding="ascii", errors="ignore"'),),
    ),
    Planted(
        "notifier",
        "nobody hears that nobody heard",
        "says_when_nobody_takes_it",
        "tell did not raise AccessError",
        (
            (
                "            raise AccessError.at(Place(str(options.file)), reason) from error",
                "            del reason",
            ),
        ),
    ),
)
_UP_DOWN = ('"{at:.4f} {up:.2f} {down:.2f}', "up, down in rows")
_CONTROLLERS = (
    Planted(
        "controller",
        "the sign is wrong in both ways",
        "reads_what_its_maker_prints",
        "(sign, direction and unit are the control's)",
        (
            ("from_si(-each)", "from_si(each)"),
            ("-MICROMETRE.to_si(rows[:, 1])", "MICROMETRE.to_si(rows[:, 1])"),
            ("-MICROMETRE.to_si(rows[:, 2])", "MICROMETRE.to_si(rows[:, 2])"),
        ),
    ),
    Planted(
        "controller",
        "directions are swapped in both ways",
        "reads_what_its_maker_prints",
        "of the maker's file 1.5 µm are read at 0 mm forward; the control takes 0 µm away",
        (
            ("(table.forward, table.reverse)", "(table.reverse, table.forward)"),
            ("rows[:, 1]", "rows[:, 9]"),
            ("rows[:, 2]", "rows[:, 1]"),
            ("rows[:, 9]", "rows[:, 2]"),
        ),
    ),
    Planted(
        "controller",
        "corrections are rounded to 1 µm",
        "reads_what_it_writes",
        "the control takes steps of 0.01 µm",
        (("{up:.2f} {down:.2f}", "{up:.0f} {down:.0f}"),),
    ),
    Planted(
        "controller",
        "positions are cut to millimetres",
        "reads_what_it_writes",
        "m off its position",
        (("{at:.4f}", "{int(at)}"),),
    ),
    Planted(
        "controller",
        "the sign is wrong in the file",
        "reads_what_it_writes",
        "read back, the table is off by",
        (("from_si(-each)", "from_si(each)"),),
    ),
    Planted(
        "controller",
        "the last row is lost",
        "reads_what_it_writes",
        "has 10 rows instead of 11",
        (
            ("rows = zip(positions", "rows = zip(positions[:-1]"),
            ("*corrections, strict=True", "*corrections, strict=False"),
        ),
    ),
    Planted(
        "controller",
        "rows that do not rise are written",
        "refuses_rows_that_do_not_rise",
        "rows that do not rise are not refused",
        (("np.diff(table.positions) <= 0", "np.diff(table.positions) < -1"),),
    ),
)
_CSV = ('table = csv.writer(text, lineterminator="\\n")\n        table.writerow((', "text.write(_row((")
_RENDERERS = (
    Planted(
        "renderer",
        "a user's comma begins a cell",
        "sets_markup_as_text",
        "row 2 has 8 cells, and the first has 7",
        (
            _CSV,
            ("table.writerow(\n                    (", "text.write(_row(\n                    ("),
            (', "limit"))', ', "limit")))'),
            ("                    )\n                )\n", "                    )\n                ))\n"),
            (
                "\n\n@hookimpl",
                '\n\ndef _row(cells):  # type: ignore\n    return ",".join(map(str, cells)) + "\\n"\n\n\n@hookimpl',
            ),
        ),
    ),
    Planted(
        "renderer",
        "the file is Latin-1",
        "keeps_letters_and_signs",
        "do not come out as they were typed",
        (("getvalue().encode()", 'getvalue().encode("latin-1", "replace").decode("latin-1").encode()'),),
    ),
    Planted(
        "renderer",
        "the file is Latin-1 and nothing says so",
        "keeps_letters_and_signs",
        "the file is not UTF-8",
        (("getvalue().encode()", 'getvalue().encode("latin-1", "replace")'),),
    ),
    Planted(
        "renderer",
        "parameters are sorted",
        "keeps_the_order",
        "parameters are not in the order of the certificate",
        (
            (
                "in evaluation.parameters:",
                "in sorted(evaluation.parameters, key=lambda each: each.quantity.symbol):",
            ),
        ),
    ),
    Planted(
        "renderer",
        "a slope is written as a length",
        "keeps_the_order",
        "a parameter is in SI, or in its own unit",
        (
            (
                "parameter.quantity.unit_or(evaluation.measurements.axis.deviation_unit)",
                "evaluation.measurements.axis.deviation_unit",
            ),
        ),
    ),
    Planted(
        "renderer",
        "values are nanometres",
        "prints_what_the_document_says",
        "does not carry the value of the parameter D",
        (("unit.from_si(parameter.value),", "1e3 * unit.from_si(parameter.value),"),),
    ),
    Planted(
        "renderer",
        "the day is written",
        "reads_no_clock",
        "other bytes on another date",
        (
            ('("certificate", "standard"', '(time.ctime(), "standard"'),
            ("import csv\nimport io\n", "import csv\nimport io\nimport time\n"),
        ),
    ),
)
_INSTRUMENTS = (
    Planted(
        "instrument",
        "a garbled answer is taken",
        "no_garbled_answer_is_usable",
        "garbled (a digit is another, and the check sum is not)",
        ((' or check_sum(found["text"]) != found["sum"]', ""),),
    ),
    Planted(
        "instrument",
        "a lost beam is an unreadable line",
        "tells_of_a_lost_beam",
        "the beam was lost, and no reading says so",
        (("Fault.BEAM_LOST", "Fault.UNREADABLE"),),
    ),
    Planted(
        "instrument",
        "the emulator knows no lost beam",
        "tells_of_a_lost_beam",
        "the beam was lost, and no reading says so",
        (("troubles.has(Trouble.LOST_BEAM, at) or ", ""),),
    ),
    Planted(
        "instrument",
        "readings are millimetres",
        "follows_the_axis",
        "(SI is expected)",
        (('MILLIMETRE.to_si(float(found["text"]))', 'float(found["text"])'),),
    ),
)
_PROGRAMS = (
    Planted(
        "program",
        "no feed before the first motion",
        "moves_at_the_planned_feed",
        "the motion to stop 1 has the feed nan; expected 1500 mm/min",
        (('    yield f"F{program_number(motion.feed)}"\n', ""),),
    ),
    Planted(
        "program",
        "the feed is in metres a minute",
        "moves_at_the_planned_feed",
        "the motion to stop 1 has the feed 2; expected 1500 mm/min",
        (("F{program_number(motion.feed)}", "F{motion.feed / 1000:.0f}"),),
    ),
    Planted(
        "program",
        "the time at rest is in milliseconds",
        "leads_to_every_reading_from_its_side",
        "for 3500 s; expected",
        (("program_number(motion.dwell)", "program_number(1000 * motion.dwell)"),),
    ),
    Planted(
        "program",
        "turning points are left out",
        "leads_to_every_reading_from_its_side",
        "stops; expected 21",
        (
            (
                '        yield f"G53 G1',
                '        if not stop.reading:\n            continue\n        yield f"G53 G1',
            ),
        ),
    ),
    Planted(
        "program",
        "a name is taken for a command",
        "takes_no_name_for_a_command",
        "the program cannot be run",
        (('    yield "G21', '    yield f"(AXIS {motion.axis.name})"\n    yield "G21'),),
    ),
)
PLANTED = (
    *_STANDARDS,
    *_EFFECTS,
    *_SOURCES,
    *_NOTIFIERS,
    *_CONTROLLERS,
    *_RENDERERS,
    *_INSTRUMENTS,
    *_PROGRAMS,
)
