"""A sound calibration certificate of an axis of 1 m, to be spoilt as an assessor finds them."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

from document.certificate import documents
from document.certificate.documents import certificate, text_of, without
from doubtful import doubtful_jobs
from installed import registry
from zlmreport.plugin import Approach, InputError
from zlmreport.plugin.renderer import Certificate, EvaluatedParameter

#: Everything that an assessor could ask for is stated.
SOUND: Mapping[str, Any] = {
    "schema": "zlmreport/job/1",
    "certificate": {
        "number": "CAL-1",
        "issued": "2026-11-20",
        "authorised_by": {"name": "A. Person", "function": "Head"},
    },
    "laboratory": {"name": "Some Laboratory", "address": "Street 1, 12345 Town"},
    "customer": {"name": "A Customer", "address": "Lane 2, 54321 Village"},
    "machine": {"manufacturer": "Maker", "model": "M1", "serial": "S-1"},
    "location": {"kind": "customer"},
    "axis": {"name": "X", "travel": [0, 1000]},
    "measurement": {"date": "2026-11-18", "source": {"plugin": "laser-csv", "file": "x.csv"}},
    "instrument": {
        "name": "Laser interferometer",
        "certificate": "C-1",
        "calibrated": "2026-03-02",
        "expanded_uncertainty": 0.4,
        "compensation": "refractive index of the air",
    },
    "environment": {
        "air_temperature": 20.1,
        "axis_temperature": 20.0,
        "expansion_coefficient": 11.5,
        "thermometers": [{"name": "T 1", "certificate": "T-1", "calibrated": "2026-02-01"}],
    },
    "uncertainty": {
        "misalignment": 0.3,
        "machine_temperature": 0.1,
        "expansion_coefficient": 1,
        "environmental_variation": 1,
        "negligible": {
            "device_temperature": "laser, no length of its own",
            "device_expansion_coefficient": "laser, no length of its own",
        },
    },
    "evaluate": [{"standard": "iso230-2:2014", "tolerances": {"A": 10, "R": 5}}],
}

#: Deviations in µm, (target, direction, run), and the temperatures beside them, if any.
Readings = tuple[np.ndarray, np.ndarray | None]
TARGETS = np.array([3.1, 104.2, 201.7, 303.9, 398.3, 502.6, 601.4, 703.8, 799.2, 902.5, 996.4])
RUNS = 5


def order() -> list[tuple[int, int, int]]:
    """Return target, direction and run of each reading, in the order of the linear method."""
    count = len(TARGETS)
    return [
        (target, direction, run)
        for run in range(RUNS)
        for direction, targets in ((0, range(count)), (1, reversed(range(count))))
        for target in targets
    ]


def readings(scatter: float = 0.4, *, seed: int = 1, slope: float = 2.0, decimals: int = 2) -> np.ndarray:
    """Return deviations of an axis, µm: a slope (µm over the travel), a wave, a reversal of 0.8, a "
    "scatter."""
    generator = np.random.default_rng(seed)
    bow = slope * TARGETS / 1000 + 0.8 * np.sin(TARGETS / 160)
    true = bow[:, np.newaxis, np.newaxis] + np.array([0.4, -0.4])[:, np.newaxis]
    return np.round(true + scatter * generator.standard_normal((len(TARGETS), 2, RUNS)), decimals)


def write(
    folder: Path,
    deviations: np.ndarray,
    logged: Mapping[str, Sequence[float | None]] | None = None,
    file: str = "x.csv",
) -> None:
    """Write readings with what was logged beside each; an empty cell where nothing was."""
    values = logged or {}
    lines = [",".join(["target,direction,run,deviation", *values])]
    for number, (target, direction, run) in enumerate(order()):
        beside = ["" if each[number] is None else f"{each[number]:.6g}" for each in values.values()]
        at = f"{TARGETS[target]},{'+-'[direction]},{run + 1},{deviations[target, direction, run]:.6g}"
        lines.append(",".join([at, *beside]))
    (folder / file).write_text("\n".join(lines) + "\n", encoding="utf-8")


def changed(*changes: tuple[str, Any], of: Mapping[str, Any] = SOUND) -> dict[str, Any]:
    """Return the keys with others in the place of some: dotted keys with their values."""
    keys = dict(of)
    for dotted, value in changes:
        keys = documents.having(dotted, value, keys)
    return keys


def composed(
    folder: Path,
    keys: Mapping[str, Any],
    deviations: np.ndarray | None = None,
    trials: int = documents.FEW_TRIALS,
    **logged: Sequence[float | None],
) -> Certificate:
    """Return the document of a job on these readings."""
    write(folder, readings() if deviations is None else deviations, logged)
    return documents.certificate(folder, keys, trials)


def refusals(
    folder: Path,
    keys: Mapping[str, Any],
    deviations: np.ndarray | None = None,
    **logged: Sequence[float | None],
) -> str:
    """Return why a job is refused, as one text; empty if it is not."""
    try:
        composed(folder, keys, deviations, **logged)
    except InputError as error:
        return "\n".join(str(each) for each in error.problems)
    return ""


def cover(document: Certificate) -> str:
    """Return the first page as plain lines."""
    return "\n".join(line for block in document.cover for line in documents.lines_of(block))


def parameter(document: Certificate, symbol: str) -> EvaluatedParameter:
    """Return a result by the first standard."""
    found = document.evaluations[0].parameter(symbol)
    assert found is not None
    return found


def first_page(document: Certificate) -> str:
    """Return the first page: of a sheet all of it."""
    is_sheet = document.job is not None and document.job.keys.certificate.layout == "sheet"
    return text_of(document) if is_sheet else cover(document)


REPORT = ("certificate.kind", "report")
GERMAN = ("certificate.language", "de")
SHEET, STANDARD = ("certificate.layout", "sheet"), ("certificate.layout", "standard")
#: An axis that turns, and a straightness: what is stated of lengths along the axis is left out.
TURNING: Mapping[str, Any] = {
    **without("environment.expansion_coefficient", "uncertainty", keys=SOUND),
    "certificate": {**SOUND["certificate"], "kind": "report"},
    "axis": {"name": "C", "kind": "rotary", "travel": [0, 360]},
    "instrument": {**without("compensation", keys=SOUND["instrument"]), "name": "Autocollimator"},
    "uncertainty": {"environmental_variation": 0.3},
}
ANGLES = np.array([0.0, 31, 64, 90, 127, 158, 180, 221, 249, 270, 338])


def by(standard: str, **limits: float) -> tuple[str, Any]:
    """Return the key of a standard with its limits."""
    return ("evaluate", [{"standard": standard, "tolerances": limits}])


def rising(deviations: np.ndarray) -> np.ndarray:
    """Return readings that rise by 12 from the first to the last."""
    moved = deviations.copy()
    for number, at in enumerate(order()):
        moved[at] += 12 * number / len(order())
    return moved


def with_outlier(deviations: np.ndarray) -> np.ndarray:
    moved = deviations.copy()
    moved[4, 1, 1] += 60
    return moved


def one_direction_twice(deviations: np.ndarray) -> np.ndarray:
    return np.repeat(deviations[:, :1], 2, axis=1)


def same(deviations: np.ndarray) -> np.ndarray:
    return deviations


@dataclass(frozen=True)
class Doubtful:
    """A job, its readings with what was logged beside them, and what is said of them, and where."""

    keys: Mapping[str, Any]
    said: str
    spoil: Callable[[np.ndarray], np.ndarray] = same
    targets: np.ndarray = field(default_factory=lambda: TARGETS)
    runs: int = 5
    logged: Mapping[str, Sequence[float | None]] = field(default_factory=dict)
    said_in: Callable[[Certificate], str] = first_page


def make_test_of(jobs: Mapping[str, Doubtful]) -> Callable[..., None]:
    """Return the test that a document says what is doubtful of each job, and nothing that is not so."""

    @pytest.mark.parametrize("job", jobs.values(), ids=jobs)
    def is_marked(job: Doubtful, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setattr(doubtful_jobs, "TARGETS", job.targets)
        monkeypatch.setattr(doubtful_jobs, "RUNS", job.runs)

        document = composed(tmp_path, job.keys, job.spoil(readings()), **job.logged)

        said = job.said_in(document)
        assert job.said in said, said
        assert not (untrue := false_in(document)), untrue

    return is_marked


def false_in(document: Certificate) -> list[str]:
    """Return what a document says that is not so, by what else it says."""
    text, job = text_of(document), document.job
    is_german, is_report = document.language.value == "de", job.keys.certificate.kind == "report"
    parameters = [each for of in document.evaluations for each in of.parameters]
    marked = [each.in_language(document.language) for each in (*document.doubts, *document.evidence)]
    broken = (
        "fällig",
        "was due",
        "nach der Messung",
        "after the measurement",
        "no calibration certificate named",
    )
    of_instrument = [each for each in marked if each.startswith(("Messgerät", "Measuring instrument"))]
    of_results = json.loads(registry().renderer("json").render(document)).get("doubtful", [])
    found = {
        "a place that nothing fills": bool(re.search(r"\{[a-z_]+\}", text)),
        "one of several": bool(
            re.search(
                r"(?<![\d.,])1 (?:runs|readings|positions|more|Durchläufe|Messwerte|Positionen|weitere)\b",
                text,
            )
        ),
        "an interval that no table has": ("nterval of the axis" in text or "Intervall der Achse" in text)
        and all(each.axis_interval is None for each in parameters),
        "a chain that is broken": any(word in each for word in broken for each in of_instrument)
        and ("metrologically traceable" in text or "metrologisch rückführbar" in text),
        "a report that calibrates": is_report
        and bool(
            re.search(
                "tem calibrated|Kalibriergegenstand|^Kalibrierung$|^Calibration$",
                text,
                re.MULTILINE,
            )
        ),
        "no word of the field": is_german and bool(re.search(r"\bZeichen \||kalibrierten Gegenstand", text)),
        "drift out of sight": "cannot be judged" in text or "nicht zu erkennen" in text,
        "a mark that only the page has": of_results != marked or any(each not in text for each in marked),
        "a direction that is not there": any(word in text for word in ("both directions", "beide Richtungen"))
        and set(document.measurements.approaches) != set(Approach),
    }
    return [what for what, is_so in found.items() if is_so]


def machine(
    folder: Path, parts: Mapping[str, tuple[Mapping[str, Any], np.ndarray]], **keys: str
) -> Certificate:
    """Return one document of several axes: each with its own job and readings."""
    shared = {each: SOUND[each] for each in ("schema", "laboratory", "customer", "machine", "location")}
    own = {**SOUND["certificate"], "kind": "report", **keys}
    for number, (name, (job, deviations)) in enumerate(parts.items()):
        write(folder, deviations)
        (folder / "x.csv").rename(folder / f"{name}.csv")
        source = {"plugin": "laser-csv", "file": f"{name}.csv"}
        part = changed(
            ("axis.name", name),
            ("measurement.source", source),
            ("certificate", {**own, "number": f"CAL-1-{number}"}),
            of=job,
        )
        (folder / f"{name}.yaml").write_text(yaml.safe_dump(part), encoding="utf-8")
    return certificate(
        folder, {**shared, "certificate": own, "measurements": [f"{name}.yaml" for name in parts]}
    )
