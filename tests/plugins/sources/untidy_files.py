"""Files as workshops have them, each with the same readings; nobody tidied them up for a program.

All hold positions and deviations of one invented axis. What each is like is said by its name.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from io import BytesIO

import numpy as np
from openpyxl import Workbook

#: mm; and deviations in µm by direction, run and target.
TARGETS = (0.0, 420.0, 840.0, 1260.0)
UP = ((0.2, 1.3, 2.9, -4.6), (0.4, 1.1, 3.1, -4.2))
DOWN = ((-1.1, 0.1, 1.8, -6.0), (-0.9, 0.3, 1.6, -5.8))
#: The same, (direction, target, run).
GRID = np.array([np.transpose(UP), np.transpose(DOWN)])
#: Degrees and arc seconds of the files on a rotary axis.
ANGLES = (0.0, 90.0, 180.0, 270.0)


def german(value: float, decimals: int = 1) -> str:
    """Return a number with a decimal comma."""
    return f"{value:.{decimals}f}".replace(".", ",")


def rows() -> list[tuple[float, int, int, float]]:
    """Return target, direction, run and deviation of each reading, in the order in which they were taken."""
    return [
        (TARGETS[index], sense, run + 1, grid[run][index])
        for run in range(2)
        for sense, grid in ((1, UP), (-1, DOWN))
        for index in range(len(TARGETS))[::sense]
    ]


@dataclass(frozen=True)
class Untidy:
    """A file, and what must come of it."""

    name: str
    content: bytes
    keys: dict[str, object]  #: That read it.
    axis: str = ""  #: Its letter, where the file names it.
    kind: str = "linear"
    #: (direction, target, run), µm or ″; NaN where missing.
    grid: np.ndarray = field(default_factory=lambda: GRID)


def text(*lines: str, encoding: str = "utf-8") -> bytes:
    """Return lines as Windows saves them."""
    return "\r\n".join([*lines, ""]).encode(encoding)


def workbook(**sheets: Sequence[Sequence[object]]) -> bytes:
    """Return a workbook of sheets."""
    book, saved = Workbook(), BytesIO()
    book.remove(book.active)
    for title, cells in sheets.items():
        sheet = book.create_sheet(title)
        for row in cells:
            sheet.append(list(row))
    book.save(saved)
    return saved.getvalue()


def _german_export() -> Untidy:
    """A laser's export in Latin-1: a head, a row of units, decimal commas, clock times, a foot."""
    return Untidy(
        "messung_04.txt",
        text(
            "Messprotokoll Laserinterferometer",
            "Maschine:;Fräsmaschine Nr. 4711",
            "Achse: Y",
            "Prüfer:;Jürgen Groß",
            "",
            "Nr.;Sollposition;Richtung;Messlauf;Abweichung;Uhrzeit;Luft;Bemerkung",
            ";[mm];;;[µm];;[°C];",
            *(
                f"{number};{german(target, 3)};{'vorwärts' if sense > 0 else 'rückwärts'};{run};"
                f"{german(value)};08:{15 + number}:03;20,{number};{'Tür offen' if number == 3 else ''}"
                for number, (target, sense, run, value) in enumerate(rows(), 1)
            ),
            "",
            "Ende des Protokolls",
            encoding="cp1252",
        ),
        {
            "encoding": "cp1252",
            "skip_rows": 5,
            "ends_before": "Ende des Protokolls",
            "columns": {
                "target": "Sollposition",
                "direction": "Richtung",
                "run": "Messlauf",
                "deviation": "Abweichung",
                "time": "Uhrzeit",
            },
            "ignore": ["Nr.", "Bemerkung"],
        },
        axis="Y",
    )


def _american_export() -> Untidy:
    """A spreadsheet's CSV: its line on the delimiter, thousands, quotation marks, summary rows below."""
    table = [
        f'"{target:,.3f}",{UP[0][index]},{DOWN[0][index]},{UP[1][index]},{DOWN[1][index]},note {index}'
        for index, target in enumerate(TARGETS)
    ]
    return Untidy(
        "export.csv",
        text(
            "sep=,",
            "Target (mm),Run 1 fwd (µm),Run 1 bwd (µm),Run 2 fwd (µm),Run 2 bwd (µm),Comment",
            *table,
            ",,,,,",
            "Mean,-0.05,-1.3,0.1,-1.2,",
            "Std. dev.,3.2,3.4,3.1,3.3,",
            encoding="utf-8-sig",
        ),
        {
            "ends_before": "Mean",
            "thousands": "comma",
            "layout": "wide",
            "ignore": ["Comment"],
        },
    )


def _unicode_text() -> Untidy:
    """UTF-16 with tabs, as a spreadsheet saves "Unicode text": arrows, means, a missing reading in words."""
    grid = GRID.copy()
    grid[1, 2, 1] = np.nan
    return Untidy(
        "X-Achse.txt",
        text(
            "Position / mm\t1. Lauf ↑\t1. Lauf ↓\t2. Lauf ↑\t2. Lauf ↓\tMittelwert",
            *(
                "\t".join(
                    [
                        german(target, 0),
                        german(UP[0][index]),
                        german(DOWN[0][index]),
                        german(UP[1][index]),
                        "---" if index == 2 else german(DOWN[1][index]),
                        german(0.5),
                    ]
                )
                for index, target in enumerate(TARGETS)
            ),
            encoding="utf-16",
        ),
        {
            "encoding": "utf-16",
            "missing": ["---"],
            "layout": "wide",
            "columns": {
                "target": "Position",
                "1+": "1. Lauf ↑",
                "1-": "1. Lauf ↓",
                "2+": "2. Lauf ↑",
                "2-": "2. Lauf ↓",
            },
            "ignore": ["Mittelwert"],
        },
        axis="X",
        grid=grid,
    )


def _two_sheets() -> Untidy:
    """A workbook with a cover sheet; on the other the runs span two columns each, below a head."""
    return Untidy(
        "Protokoll.xlsx",
        workbook(
            Deckblatt=[["Prüfprotokoll"], ["Maschine", "DMC 80"], ["Datum", "18.11.2026"]],
            Messwerte=[
                ["Werte in µm"],
                [],
                ["Position\n[mm]", "Lauf 1", None, "Lauf 2", None, "Mittel"],
                [None, "auf", "ab", "auf", "ab", None],
                *(
                    [target, UP[0][index], DOWN[0][index], UP[1][index], DOWN[1][index], 0.5]
                    for index, target in enumerate(TARGETS)
                ),
                [],
                ["Spannweite", 7.5, 7.8, 7.3, 7.4],
            ],
        ),
        {
            "sheet": "Messwerte",
            "skip_rows": 2,
            "ends_before": "Spannweite",
            "header_rows": 2,
            "layout": "wide",
            "columns": {"target": "Position"},
            "units": {"deviation": "µm"},
            "ignore": ["Mittel"],
        },
    )


def _transposed() -> Untidy:
    """A table that lies on its side below a head: targets to the right, a mean at their end."""
    return Untidy(
        "quer.csv",
        text(
            "Messprotokoll;Achse Z",
            "Datum;18.11.2026",
            "",
            f"Position [mm];{';'.join(german(target, 1) for target in TARGETS)};Mittelwert",
            *(
                f"Lauf {run} {name} [µm];{';'.join(map(german, grid[run - 1]))};0,1"
                for run in (1, 2)
                for name, grid in (("hin", UP), ("rück", DOWN))
            ),
            "Umkehrspanne;1,3;1,2;1,1;1,4;1,2",
        ),
        {
            "skip_rows": 3,
            "ends_before": "Mittelwert",
            "delimiter": "semicolon",
            "transposed": True,
            "layout": "wide",
            "columns": {"target": "Position"},
            "ignore": ["Umkehrspanne"],
        },
        axis="Z",
    )


def _transposed_sheet() -> Untidy:
    """An English sheet on its side, units in its second column, statistics below it."""
    runs = [
        [f"Run {run} {name}", "um", *grid[run - 1]]
        for run in (1, 2)
        for name, grid in (("forward", UP), ("reverse", DOWN))
    ]
    return Untidy(
        "linear x.xlsx",
        workbook(
            Data=[
                ["Customer", "Example Ltd"],
                [],
                ["Nominal position", "mm", *TARGETS],
                *runs,
                ["Average", "um", 0.1, 0.2, 0.3, 0.4],
                ["Repeatability", "um", 0.1, 0.2, 0.3, 0.4],
            ]
        ),
        {
            "skip_rows": 2,
            "transposed": True,
            "layout": "wide",
            "columns": {"target": "Nominal position"},
            "ignore": ["Average", "Repeatability"],
        },
    )


def _rotary() -> Untidy:
    """A rotary table: degrees, minutes and seconds, deviations in seconds, neither directions nor runs."""
    angles = {0.0: "0° 00′ 00″", 90.0: "90° 00′ 00″", 180.0: "180° 00′ 00″", 270.0: "270° 00′ 00″"}
    of_target = dict(zip(TARGETS, ANGLES, strict=True))
    return Untidy(
        "rundtisch.csv",
        text(
            "# Achse C, Polygonspiegel",
            'Winkel [°];Abw. ["]',
            *(f"{angles[of_target[target]]};{german(value)}" for target, _, _, value in rows()),
        ),
        {
            "direction": "by-order",
            "runs": "counted",
            "columns": {"target": "Winkel", "deviation": "Abw."},
            "units": {"deviation": "arcsec"},
        },
        axis="C",
        kind="rotary",
    )


def _positions_with_blanks() -> Untidy:
    """Actual positions with blanks in their thousands, aligned by blanks, units behind the numbers."""
    return Untidy(
        "laser.dat.txt",
        text(
            "Soll          Ist             Richtung  Zyklus",
            *(
                f"{_spaced(target, 1)} mm  {_spaced(target + value / 1000, 4)} mm  {sense:+d}  {run}"
                for target, sense, run, value in rows()
            ),
        ),
        {
            "delimiter": "blanks",
            "thousands": "blank",
            "columns": {"target": "Soll", "direction": "Richtung", "run": "Zyklus", "position": "Ist"},
        },
    )


def _spaced(value: float, decimals: int) -> str:
    return f"{value:,.{decimals}f}".replace(",", " ").replace(".", ",")


def _two_blocks() -> Untidy:
    """One table of each direction, below each other; runs are only numbered."""
    blocks = [
        line
        for name, grid in (("Forward", UP), ("Backward", DOWN))
        for line in (
            name,
            "Position;Run 1;Run 2",
            *(f"{target};{grid[0][index]};{grid[1][index]}" for index, target in enumerate(TARGETS)),
            "",
        )
    ]
    return Untidy(
        "blocks.csv",
        text("Positioning test, deviations in um", *blocks),
        {
            "layout": "wide",
            "columns": {"target": "Position"},
            "units": {"deviation": "um"},
            "parts": [{"lines": [3, 7], "direction": "+"}, {"lines": [10, 14], "direction": "-"}],
        },
    )


def _a_table_of_each_pass() -> Untidy:
    """One table of each run and direction, below each other; runs stand above them in words."""
    blocks, parts = [], []
    for run in range(2):
        for name, sign, grid in (("vorwärts", "+", UP), ("rückwärts", "-", DOWN)):
            first = len(blocks) + 2
            parts.append({"lines": [first, first + len(TARGETS)], "direction": sign})
            values = zip(TARGETS, grid[run], strict=True)
            rows_ = [f"{target};{value}" for target, value in list(values)[:: 1 if sign == "+" else -1]]
            blocks += [f"Lauf {run + 1} {name}", "Soll;Abweichung (um)", *rows_, ""]
    return Untidy(
        "durchgänge.csv",
        text(*blocks),
        {
            "columns": {"target": "Soll", "deviation": "Abweichung"},
            "parts": parts,
            "runs": "counted",
        },
    )


def _a_table_of_each_pass_without_a_word() -> Untidy:
    """The same without a word of run and direction: targets rise and fall in turn."""
    blocks, parts = [], []
    for run in range(2):
        for sense, grid in ((1, UP), (-1, DOWN)):
            parts.append({"lines": [len(blocks) + 1, len(blocks) + 1 + len(TARGETS)]})
            values = list(zip(TARGETS, grid[run], strict=True))[::sense]
            blocks += ["target,deviation", *(f"{target},{value}" for target, value in values), ""]
    return Untidy("passes.csv", text(*blocks), {"direction": "by-order", "parts": parts, "runs": "counted"})


def _sheets_of_directions() -> Untidy:
    """A workbook with a sheet of each direction."""

    def sheet(grid: Sequence[Sequence[float]]) -> list[list[object]]:
        return [
            ["Soll (mm)", "Messung 1", "Messung 2"],
            *([target, grid[0][index], grid[1][index]] for index, target in enumerate(TARGETS)),
        ]

    return Untidy(
        "hin und rück.xlsx",
        workbook(**{"Messung hin": sheet(UP), "Messung rück": sheet(DOWN)}),
        {
            "layout": "wide",
            "columns": {"target": "Soll"},
            "parts": [
                {"sheet": "Messung hin", "direction": "+"},
                {"sheet": "Messung rück", "direction": "-"},
            ],
        },
    )


def _nominal_minus_actual() -> Untidy:
    """Deviations of the other sign beside the positions that tell it, in mm; commented names; no runs."""
    return Untidy(
        "raw.tsv",
        text(
            "# measured 2026-11-18",
            "Nominal\tMeasured\tError\tDir\tTemp\tOperator",
            *(
                f"{target:.1f}\t{target + value / 1000:.4f}\t{-value / 1000:.4f}\t"
                f"{'U' if sense > 0 else 'D'}\t20.1\tAB"
                for target, sense, _, value in rows()
            ),
        ),
        {
            "runs": "counted",
            "sign": "nominal-actual",
            "columns": {"target": "Nominal", "direction": "Dir", "deviation": "Error"},
            "units": {"deviation": "mm"},
            "ignore": ["Measured", "Operator"],
        },
    )


def _without_names() -> Untidy:
    """Two columns of numbers, as a program of one's own writes them; a comment names them."""
    return Untidy(
        "log.txt",
        text(
            "# x-axis, run on 18 Nov",
            "# target deviation",
            *(f"{target} {value}" for target, _, _, value in rows()),
        ),
        {
            "delimiter": "blanks",
            "header": ["target", "deviation"],
            "direction": "by-order",
            "runs": "counted",
        },
        axis="X",
    )


def _empty_corner() -> Untidy:
    """A sheet whose corner is empty and whose columns are only called up and down."""
    return Untidy(
        "corner.xlsx",
        workbook(
            Sheet1=[
                ["", "up", "down", "up", "down"],
                *(
                    [target, UP[0][index], DOWN[0][index], UP[1][index], DOWN[1][index]]
                    for index, target in enumerate(TARGETS)
                ),
            ]
        ),
        {"skip_rows": 1, "header": ["target", "1+", "1-", "2+", "2-"], "layout": "wide"},
    )


def _passes_as_runs() -> Untidy:
    """Every pass has a number of its own, up and down in turn; the direction is nowhere."""
    numbered = [(target, 2 * run - (sense > 0), value) for target, sense, run, value in rows()]
    return Untidy(
        "passes.csv",
        text("Target;Run;Deviation [um]", *(f"{target};{run};{value}" for target, run, value in numbered)),
        {"direction": "by-order", "runs": "counted", "ignore": ["Run"]},
    )


def _abbreviated_direction() -> Untidy:
    """A column of signs under a name that nobody foresaw."""
    signs = {1: "+", -1: "-"}
    return Untidy(
        "abbreviated.csv",
        text(
            "Soll;Richt.;Lauf;Abw. (µm)",
            *(f"{target};{signs[sense]};{run};{value}" for target, sense, run, value in rows()),
        ),
        {"columns": {"target": "Soll", "direction": "Richt.", "run": "Lauf", "deviation": "Abw."}},
    )


def _without_umlauts() -> Untidy:
    """German words for both directions, from a keyboard that has no umlauts."""
    return Untidy(
        "hin-und-zurueck.csv",
        text(
            "Position;Hin 1;Zurueck 1;Hin 2;Zurueck 2",
            *(
                f"{target};{UP[0][index]};{DOWN[0][index]};{UP[1][index]};{DOWN[1][index]}"
                for index, target in enumerate(TARGETS)
            ),
        ),
        {"layout": "wide", "columns": {"target": "Position"}},
    )


def _a_table_of_each_run() -> Untidy:
    """Runs one below the other, each under its title and its own header; no column numbers them."""
    lines = ["Laser report"]
    for run in (1, 2):
        lines += [f"Run {run}", "Target,Dir,Dev (um)"]
        lines += [
            f"{target},{'fwd' if sense > 0 else 'bwd'},{value}"
            for target, sense, each, value in rows()
            if each == run
        ]
        lines += [""]
    return Untidy(
        "runs.csv",
        text(*lines, "End of report"),
        {
            "runs": "counted",
            "parts": [{"lines": [3, 11]}, {"lines": [14, 22]}],
            "columns": {"direction": "Dir", "deviation": "Dev"},
        },
    )


def _a_table_of_each_run_with_both_directions() -> Untidy:
    """Runs one below the other, each with a column of each direction."""
    lines: list[str] = []
    for run in range(2):
        lines += [f"Run {run + 1}", "Target,Forward,Reverse"]
        lines += [f"{target},{UP[run][index]},{DOWN[run][index]}" for index, target in enumerate(TARGETS)]
        lines += [""]
    return Untidy(
        "blocks.csv",
        text(*lines),
        {
            "layout": "wide",
            "parts": [{"lines": [2, 6]}, {"lines": [9, 13]}],
            "runs": "counted",
            "columns": {"1+": "Forward", "1-": "Reverse"},
        },
    )


def _runs_below_each_other_under_one_header() -> Untidy:
    """A row for each target of each run, and a column of each direction."""
    lines = [
        f"{run + 1};{target};{UP[run][index]};{DOWN[run][index]}"
        for run in range(2)
        for index, target in enumerate(TARGETS)
    ]
    return Untidy(
        "rows.csv",
        text("Run;Target;Forward;Reverse", *lines),
        {
            "layout": "wide",
            "runs": "counted",
            "columns": {"1+": "Forward", "1-": "Reverse"},
            "ignore": ["Run"],
        },
    )


def _runs_with_names() -> Untidy:
    """Runs that have words; and a target that one run left out."""
    grid = GRID.copy()
    grid[0, 1, 1] = np.nan
    lines = [
        f"{target},{sense:+d},Run {run},{value}"
        for target, sense, run, value in rows()
        if (target, sense, run) != (420.0, 1, 2)
    ]
    return Untidy(
        "named.csv",
        text("target,direction,run,deviation (um)", *lines),
        {"runs": "counted", "ignore": ["run"]},
        grid=grid,
    )


def _with_the_index_of_a_data_frame() -> Untidy:
    """A first column that numbers the rows and has no name."""
    lines = [
        f"{index},{target},{sense:+d},{run},{value}"
        for index, (target, sense, run, value) in enumerate(rows())
    ]
    names = ["column 1", "target", "direction", "run", "deviation (um)"]
    return Untidy(
        "frame.csv",
        text(",target,direction,run,deviation (um)", *lines),
        {"skip_rows": 1, "header": names, "ignore": ["column 1"]},
    )


def _runs_that_count_passes() -> Untidy:
    """Each pass over the targets has a number of its own: 1 upwards, 2 downwards, 3 upwards …"""
    lines = [f"{target},{sense:+d},{2 * run - (sense > 0)},{value}" for target, sense, run, value in rows()]
    return Untidy(
        "passes.csv",
        text("target,direction,run,deviation (um)", *lines),
        {"runs": "counted", "ignore": ["run"]},
    )


def _header_over_and_over() -> Untidy:
    """The header stands above each of the runs again, and nothing parts them."""
    header = "Soll;Richtung;Lauf;Abw. (µm)"
    table = [f"{target};{sense:+d};{run};{value}" for target, sense, run, value in rows()]
    return Untidy(
        "appended.csv",
        text(header, *table[:8], header, *table[8:]),
        {
            "parts": [{"lines": [1, 9]}, {"lines": [10, 18]}],
            "columns": {"target": "Soll", "direction": "Richtung", "run": "Lauf", "deviation": "Abw."},
        },
    )


def _header_again_in_a_run() -> Untidy:
    """The header stands a second time, in the middle of the first run: the longer table is the second."""
    table = [f"{target};{sense:+d};{run};{value}" for target, sense, run, value in rows()]
    header = "target;direction;run;deviation (um)"
    return Untidy(
        "again.csv",
        text(header, *table[:3], header, *table[3:]),
        {"parts": [{"lines": [1, 4]}, {"lines": [5, 18]}]},
    )


def _runs_only_counted() -> Untidy:
    """A table of each direction, the columns of its runs called by nothing but their numbers."""
    lines: list[str] = []
    for name, grid in (("Forward", UP), ("Backward", DOWN)):
        lines += [name, "Position;1;2"]
        lines += [f"{target:.0f};{grid[0][index]};{grid[1][index]}" for index, target in enumerate(TARGETS)]
        lines += [""]
    return Untidy(
        "counted.csv",
        text(*lines),
        {
            "layout": "wide",
            "columns": {"target": "Position"},
            "parts": [{"lines": [2, 6], "direction": "+"}, {"lines": [9, 13], "direction": "-"}],
        },
    )


def _unit_in_the_lower_row() -> Untidy:
    """Names of two rows, the lower one with the unit of the targets."""
    return Untidy(
        "two-rows.csv",
        text(
            "Position;Run 1;;Run 2;",
            "mm;up;down;up;down",
            *(
                f"{target};{UP[0][index]};{DOWN[0][index]};{UP[1][index]};{DOWN[1][index]}"
                for index, target in enumerate(TARGETS)
            ),
        ),
        {"header_rows": 2, "layout": "wide", "columns": {"target": "Position"}},
    )


def _arrows_and_statistics() -> Untidy:
    """Columns called by number and arrow, between them means and spans of their own direction."""
    return Untidy(
        "statistics.csv",
        text(
            "Target;1↑;2↑;Mean↑;1↓;2↓;Mean↓;B",
            *(
                f"{target};{UP[0][index]};{UP[1][index]};0.5;{DOWN[0][index]};{DOWN[1][index]};0.2;1.3"
                for index, target in enumerate(TARGETS)
            ),
        ),
        {"layout": "wide", "ignore": ["Mean↑", "Mean↓", "B"]},
    )


def _named_difference() -> Untidy:
    """Deviations whose name says which difference they are; the column of runs numbers the test."""
    return Untidy(
        "difference.csv",
        text(
            "Nominal (mm),Direction,Run,Nominal - Actual (um)",
            *(f"{target},{sense:+d},7,{-value}" for target, sense, _, value in rows()),
        ),
        {
            "runs": "counted",
            "sign": "nominal-actual",
            "columns": {"target": "Nominal", "deviation": "Nominal - Actual"},
            "ignore": ["Run"],
        },
    )


def _gon() -> Untidy:
    """A theodolite's units."""
    of_target = dict(zip(TARGETS, ANGLES, strict=True))
    return Untidy(
        "C axis in gon.csv",
        text(
            "target [gon],direction,run,deviation [mgon]",
            *(
                f"{of_target[target] / 0.9:.4f},{sense:+d},{run},{value / 3.24:.9f}"
                for target, sense, run, value in rows()
            ),
        ),
        {},
        axis="C",
        kind="rotary",
    )


def _initials_and_runs() -> Untidy:
    """A column of each run, named by the initial of its direction."""
    return Untidy(
        "initials.csv",
        text(
            "Target (mm),F1 (µm),R1 (µm),F2 (µm),R2 (µm)",
            *(
                f"{target},{UP[0][at]},{DOWN[0][at]},{UP[1][at]},{DOWN[1][at]}"
                for at, target in enumerate(TARGETS)
            ),
        ),
        {"layout": "wide", "columns": {"1+": "F1", "1-": "R1", "2+": "F2", "2-": "R2"}},
    )


_OF_CHINESE = {"target": "目标位置", "direction": "方向", "run": "次数", "deviation": "偏差"}


def _chinese() -> Untidy:
    """From a Chinese Windows: GBK, brackets of full width, numbered rows, means at the end."""
    return Untidy(
        "X轴.csv",
        text(
            "定位精度测量,,,,",
            "单位：毫米,,,,",
            "序号,目标位置（mm）,方向,次数,偏差（μm）",
            *(
                f"{number},{target},{'正向' if sense > 0 else '反向'},{run},{value}"
                for number, (target, sense, run, value) in enumerate(rows(), 1)
            ),
            "平均值,,,,0.1",
            encoding="gbk",
        ),
        {
            "encoding": "gbk",
            "skip_rows": 2,
            "ends_before": "平均值",
            "columns": _OF_CHINESE,
            "ignore": ["序号"],
        },
        axis="X",
    )


def _chinese_columns() -> Untidy:
    """A column of each run with Chinese names, its number in digits or in words, in a UTF-8 file."""
    return Untidy(
        "chinese columns.csv",
        text(
            "目标位置,第一次正向,第一次反向,正向第2次,反向第2次",
            "毫米,微米,微米,微米,微米",
            *(
                f"{target},{UP[0][at]},{DOWN[0][at]},{UP[1][at]},{DOWN[1][at]}"
                for at, target in enumerate(TARGETS)
            ),
        ),
        {"layout": "wide", "columns": {"target": "目标位置", "1+": "第一次正向", "1-": "第一次反向"}},
    )


def _markdown() -> Untidy:
    """A table as Markdown sets it, with a rule below its header."""
    return Untidy(
        "readings.md",
        text(
            "# X axis",
            "",
            "| target [mm] | 1+ | 1- | 2+ | 2- |",
            "|------------:|---:|---:|:--:|----|",
            *(
                f"| {target} | {UP[0][at] if at != 1 else ''} | {DOWN[0][at]} | {UP[1][at]} | {DOWN[1][at]} |"
                for at, target in enumerate(TARGETS)
            ),
        ),
        {"layout": "wide"},
        axis="X",
        grid=np.array([np.where(np.arange(8).reshape(4, 2) == 2, np.nan, GRID[0]), GRID[1]]),
    )


def _boxed() -> Untidy:
    """A table that strokes stand around, with a decimal comma."""
    lines = [
        f"| {german(target):>8} | {'+' if sense > 0 else '-':^9} | {run:3} | {german(value):>14} |"
        for target, sense, run, value in rows()
    ]
    rule = "+----------+-----------+-----+----------------+"
    return Untidy(
        "boxed.txt",
        text(rule, "| Soll     | Richtung  | Lauf| Abweichung µm  |", rule.replace("-", "="), *lines, rule),
        {
            "columns": {
                "target": "Soll",
                "direction": "Richtung",
                "run": "Lauf",
                "deviation": "Abweichung",
            }
        },
    )


def _targets_in_columns(*labels: str, names: Callable[[int, int], tuple[str, str]]) -> bytes:
    return text(
        ";".join([*labels, *(german(target) for target in TARGETS)]),
        *(
            ";".join([*names(run + 1, sense), *map(german, grid[run])])
            for run in range(2)
            for sense, grid in ((1, UP), (-1, DOWN))
        ),
        "Mittel;;0,1;0,1;0,1;0,1",
    )


def _targets_in_columns_below_two_labels() -> Untidy:
    """A row of each run, which run and direction begin, the run in a cell that two rows share."""
    return Untidy(
        "lying.csv",
        _targets_in_columns(
            "Lauf",
            "Richtung",
            names=lambda run, sense: (str(run) if sense > 0 else "", "auf" if sense > 0 else "ab"),
        ),
        {
            "delimiter": "semicolon",
            "transposed": True,
            "header_rows": 2,
            "layout": "wide",
            "columns": {"target": "Lauf Richtung"},
            "ignore": ["Mittel"],
        },
    )


def _targets_in_columns_below_initials() -> Untidy:
    """The same with the direction first, by its initial."""
    return Untidy(
        "lying.csv",
        _targets_in_columns(
            "Direction", "Run", names=lambda run, sense: ("F" if sense > 0 else "R", str(run))
        ),
        {
            "delimiter": "semicolon",
            "transposed": True,
            "header_rows": 2,
            "layout": "wide",
            "columns": {"target": "Direction Run", "1+": "F 1", "1-": "R 1", "2+": "F 2", "2-": "R 2"},
            "ignore": ["Mittel"],
        },
    )


FILES: tuple[Callable[[], Untidy], ...] = (
    _german_export,
    _american_export,
    _unicode_text,
    _two_sheets,
    _transposed,
    _transposed_sheet,
    _rotary,
    _positions_with_blanks,
    _two_blocks,
    _a_table_of_each_pass,
    _a_table_of_each_pass_without_a_word,
    _sheets_of_directions,
    _nominal_minus_actual,
    _without_names,
    _empty_corner,
    _passes_as_runs,
    _abbreviated_direction,
    _without_umlauts,
    _a_table_of_each_run,
    _a_table_of_each_run_with_both_directions,
    _runs_below_each_other_under_one_header,
    _runs_with_names,
    _runs_that_count_passes,
    _with_the_index_of_a_data_frame,
    _header_over_and_over,
    _header_again_in_a_run,
    _runs_only_counted,
    _unit_in_the_lower_row,
    _arrows_and_statistics,
    _named_difference,
    _gon,
    _initials_and_runs,
    _chinese,
    _chinese_columns,
    _markdown,
    _boxed,
    _targets_in_columns_below_two_labels,
    _targets_in_columns_below_initials,
)
