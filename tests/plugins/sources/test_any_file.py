"""Whatever is in a file: a measurement set, or words for the person who can mend it."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, strategies as st

from plugins.sources.reading import DATA, File
from zlmreport.plugin import InputError

SAMPLES = {
    "laser-csv": (DATA / "published" / "ecmc_0657b0d4.csv").read_text(),
    "renishaw-rtl": (DATA / "sources" / "bidirectional.rtl").read_text(),
    "ecmc": (DATA / "sources" / "ecmc_13e6c326.dat").read_text(),
}
WIDE = "target (mm);1+;1-;Run 2 fwd;Run 2 bwd\n0;1,5;2;;0,1\n100;3;-4,25;5;6\n"
#: What a damaged file has in the place of something else.
FRAGMENTS = st.one_of(
    st.sampled_from(["", ",", ";", "\t", "\n", '"', "#", "=", "[", "]", "::", ":", "-", "+", "x", "\0", "é"]),
    st.sampled_from(["0", "1", "99", "1e999", "nan", "inf", "1,5", "-.5", "1 1 0"]),
    st.sampled_from(["target", "run", "1+", "TGT_DATA[1]=", "HEADER::"]),
    st.text(max_size=5),
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("files")


@pytest.fixture(scope="module", params=SAMPLES)
def file(request: pytest.FixtureRequest, folder: Path) -> File:
    return File(request.param, folder / "x.dat")


@st.composite
def damaged(draw: st.DrawFn, sample: str) -> str:
    """Return a sample with stretches of it replaced."""
    text = sample
    for _ in range(draw(st.integers(1, 4))):
        begin = draw(st.integers(0, len(text)))
        end = min(len(text), begin + draw(st.integers(0, 40)))
        text = text[:begin] + draw(FRAGMENTS) + text[end:]
    return text


@given(data=st.data())
def test_any_bytes_are_read_or_refused(file: File, data: st.DataObject) -> None:
    content = data.draw(st.one_of(st.binary(), st.text().map(lambda text: text.encode("utf-8", "replace"))))
    with contextlib.suppress(InputError):
        file.read(content)


@given(data=st.data())
def test_any_damage_is_read_or_refused(file: File, data: st.DataObject) -> None:
    content = data.draw(damaged(SAMPLES[file.source.identifier])).encode("utf-8", "replace")
    with contextlib.suppress(InputError):
        measurements = file.read(content)
        assert np.all(np.diff(measurements.target_positions) > 0)
        assert not np.any(np.isinf(measurements.deviation))


@given(data=st.data())
def test_any_damage_of_a_wide_table_is_read_or_refused(folder: Path, data: st.DataObject) -> None:
    file = File("laser-csv", folder / "x.csv")
    with contextlib.suppress(InputError):
        file.read(data.draw(damaged(WIDE)).encode("utf-8", "replace"), layout="wide")


#: Targets in mm with four decimals at most, a millimetre apart; deviations in nm, less than that.
TARGETS = st.lists(st.integers(-500, 500), min_size=2, max_size=8, unique=True).map(
    lambda steps: [f"{step * 1.0625:.4f}" for step in sorted(steps)]
)
NANOMETRES = st.integers(-900_000, 900_000)


@st.composite
def passes(draw: st.DrawFn, targets: Sequence[str]) -> dict[tuple[int, int], list[int | None]]:
    """Return deviations in nm by run and direction, some of them missing, the first one there."""
    directions = draw(st.sampled_from([[1], [-1], [1, -1]]))
    runs = range(1, draw(st.integers(1, 4)) + 1)
    found: dict[tuple[int, int], list[int | None]] = {
        (run, direction): [draw(st.one_of(NANOMETRES, NANOMETRES, NANOMETRES, st.none())) for _ in targets]
        for run in runs
        for direction in directions
    }
    first = next(iter(found.values()))
    first[0], first[-1] = 1, 2
    return found


def micrometres(value: int | None) -> str:
    return "" if value is None else f"{value / 1000:.3f}"


@given(data=st.data())
def test_a_table_that_was_written_is_read_back_equal(folder: Path, data: st.DataObject) -> None:
    targets = data.draw(TARGETS)
    taken = data.draw(passes(targets))
    delimiter, decimal = data.draw(
        st.sampled_from([(",", "point"), (";", "point"), (";", "comma"), ("\t", "comma")])
    )
    sign = data.draw(st.sampled_from(["actual-nominal", "nominal-actual"]))
    rows = [
        (target, direction, run, None if value is None else value if sign == "actual-nominal" else -value)
        for (run, direction), values in taken.items()
        for target, value in list(zip(targets, values, strict=True))[::direction]
    ]
    lines = [
        delimiter.join([target, f"{direction:+d}", str(run), micrometres(value)])
        for target, direction, run, value in rows
    ]
    content = "\n".join([delimiter.join(["target", "direction", "run", "deviation"]), *lines])
    if decimal == "comma":
        content = content.replace(".", ",")
    file = File("laser-csv", folder / "x.csv")
    measurements = file.read(content, sign=sign, decimal=decimal)
    factor = 1 if sign == "actual-nominal" else -1
    assert measurements.target_positions.tolist() == [float(target) / 1e3 for target in targets]
    assert measurements.approach.tolist() == [row[1] for row in rows]
    assert measurements.run.tolist() == [row[2] for row in rows]
    np.testing.assert_array_equal(
        measurements.deviation,
        [math.nan if value is None else factor * float(micrometres(value)) / 1e6 for *_, value in rows],
    )


@given(data=st.data())
def test_a_test_file_that_was_written_is_read_back_equal(folder: Path, data: st.DataObject) -> None:
    targets = data.draw(TARGETS)
    taken = {
        key: values
        for key, values in data.draw(passes(targets)).items()
        if sum(value is not None for value in values) > 1 and any(values)
    }
    lines = [
        f"{number} {index + 1} {micrometres(values[index])}"
        for number, ((_, direction), values) in enumerate(taken.items(), 1)
        for index in range(len(targets))[::direction]
        if values[index] is not None
    ]
    content = "\n".join(
        ["TARGET DATA::", "Targets :", *targets, "Flags: 0", "DEVIATIONS::", "Run Target Data:", *lines]
    )
    measurements = File("renishaw-rtl", folder / "x.rtl").read(content)
    cycles = {1: 0, -1: 0}
    for (_, direction), values in taken.items():
        cycles[direction] += 1
        chosen = (measurements.approach == direction) & (measurements.run == cycles[direction])
        expected = [
            math.nan if value is None else float(micrometres(value)) / 1e6 for value in values[::direction]
        ]
        np.testing.assert_array_equal(measurements.deviation[chosen], expected)


@given(data=st.data())
def test_a_log_that_was_written_is_read_back_equal(folder: Path, data: st.DataObject) -> None:
    targets = data.draw(TARGETS)
    taken = data.draw(passes(targets))
    lines = [f"POSITIONS={len(targets)}", f"CYCLES={max(run for run, _ in taken)}"]
    lines += [f"TGT_DATA[{index}]={target}" for index, target in enumerate(targets, 1)]
    written: dict[tuple[int, int, int], float] = {}
    for (run, direction), values in taken.items():
        for index, value in enumerate(values):
            if value is not None:
                actual = f"{float(targets[index]) + value / 1e6:.6f}"
                lines.append(f"REF_DATA_{'FWD' if direction > 0 else 'BWD'}[{index + 1},{run}]={actual}")
                written[0 if direction > 0 else 1, index, run - 1] = (
                    float(actual) - float(targets[index])
                ) / 1e3
    order = data.draw(st.permutations(lines))
    measurements = File("ecmc", folder / "x.dat").read("\n".join(order))
    grid = measurements.deviations()
    assert np.count_nonzero(~np.isnan(grid)) == len(written)
    assert {place: grid[place] for place in written} == written
