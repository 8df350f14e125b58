"""What a second test says of a table: of an axis by formula, its tables read by arithmetic of its own."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from zlmreport.cli import main
from zlmreport.measurement.arrays import FloatArray

Capture = pytest.CaptureFixture[str]
#: Deviations, µm, at positions, mm, moving forward (1) or back (−1).
Axis = Callable[[FloatArray, int], FloatArray]
TARGETS = np.linspace(0, 500, 11)
PLAY = 4.0
JOB = """\
schema: zlmreport/job/1
certificate: {{number: {name}, kind: report}}
axis: {{name: X, compensation_table: {table}}}
measurement: {{source: {{plugin: laser-csv, file: {name}.csv}}}}
evaluate: ["iso230-2:2014"]
"""


def axis(positions: FloatArray, sign: int) -> FloatArray:
    return 0.01 * positions + 3 * np.sin(positions / 80) - (PLAY if sign < 0 else 0.0)


def measure(name: str, of: Axis, table: str = "none", noise: float = 0.3, seed: int = 1) -> str:
    """Write the readings of a test with five runs, and its job; return the job's name."""
    random = np.random.default_rng(seed)
    lines = ["target,direction,run,deviation"]
    for run in range(1, 6):
        for sign, word in ((1, "+"), (-1, "-")):
            values = of(TARGETS, sign) + random.normal(0, noise, len(TARGETS))
            rows = [f"{at:g},{word},{run},{value:.4f}" for at, value in zip(TARGETS, values, strict=True)]
            lines += rows[::sign]
    Path(f"{name}.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    Path(f"{name}.yaml").write_text(JOB.format(name=name, table=table), encoding="utf-8")
    return f"{name}.yaml"


def confirm(capsys: Capture, control: str) -> tuple[int, Any, str]:
    arguments = ["--controller", control, "--unconfirmed"]
    capsys.readouterr()
    code = main(["compensate", "--confirm", "before.yaml", "after.yaml", *arguments, "--json"])
    values = json.loads(capsys.readouterr().out)
    main(["compensate", "--confirm", "before.yaml", "after.yaml", *arguments])
    return code, values, " ".join(capsys.readouterr().out.split())


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize(
    ("part", "acts"),
    [(1.0, "held"), (-1.0, "wrong-sign"), (0.5, "half"), (2.0, "double"), (0.0, "not-in-effect")],
)
def test_a_table_that_replaced_another_is_held_against_the_axis_without_any(
    capsys: Capture, part: float, acts: str
) -> None:
    old = np.array([[0, 0, 0], [200, 3, -1], [500, 4, 0]], dtype=float)
    rows = "".join(f"{at:g},{up:g},{down:g}\n" for at, up, down in old)
    Path("old.csv").write_text(f"position,forward,reverse\n{rows}", encoding="utf-8")

    def before(at: FloatArray, sign: int) -> FloatArray:
        return axis(at, sign) - np.interp(at, old[:, 0], old[:, 1 if sign > 0 else 2])

    measure("before", before, table="old.csv")
    assert main(["compensate", "before.yaml", "--controller", "linuxcnc", "-o", "out"]) == 0
    table = np.loadtxt("out/before.comp")

    def after(at: FloatArray, sign: int) -> FloatArray:
        taken = np.interp(at, table[:, 0], table[:, 1 if sign > 0 else 2] - table[:, 0]) * 1e3
        return axis(at, sign) - part * taken

    measure("after", after, seed=2)
    code, values, _ = confirm(capsys, "linuxcnc")
    assert (code, values["acts"]) == (0 if acts == "held" else 1, acts)
    assert values["verdict"] == (acts if acts in {"held", "wrong-sign", "half"} else "other")
    assert values["applied"] == pytest.approx(part, abs=0.1)


@pytest.mark.parametrize(
    ("part", "backlash", "acts"),
    [
        (1.0, 0.0, "held"),
        (1.0, 1.0, "held"),
        (-1.0, 1.0, "wrong-sign"),
        (0.5, 1.0, "half"),
        (1.0, -1.0, "play-turned"),
        (1.0, 2.0, "play-twice"),
    ],
)
def test_a_table_without_directions_is_held_with_the_backlash_parameter_and_without(
    capsys: Capture, part: float, backlash: float, acts: str
) -> None:
    measure("before", axis)
    assert main(["compensate", "before.yaml", "--controller", "etalon", "--unconfirmed", "-o", "out"]) == 0
    rows = re.findall(r"^(\S+) (\S+)$", Path("out/before-etalon.txt").read_text("utf-8"), re.MULTILINE)
    table = np.array(rows, dtype=float)

    def after(at: FloatArray, sign: int) -> FloatArray:
        taken = part * np.interp(at, *table.T) * 1e3 + sign * backlash * PLAY / 2
        return axis(at, sign) - taken

    measure("after", after, seed=5)
    code, values, text = confirm(capsys, "etalon")
    assert (code, values["acts"]) == (0 if acts == "held" else 1, acts)
    assert ("backlash parameter is to take 4.0" in text or "3.9" in text) is acts.startswith("play")
    assert values["backlash"] is (backlash > 0)
    assert ("the control's backlash parameter takes it" in text) is (backlash > 0)
    if acts == "held":
        low, high = (values["forecast"]["E"][end] for end in ("low", "high"))
        assert low <= values["after"]["E"] <= high


def apply(table: FloatArray, shared: float, play: float, shift: float = 0.0) -> Axis:
    """Return an axis with a table, mm, of which each part acts so often, and so much further on, mm."""
    nominal, *both = table.T
    forward, reverse = (1e3 * (each - nominal) for each in both)
    mean, apart = (forward + reverse) / 2, (forward - reverse) / 2

    def move(at: FloatArray, sign: int) -> FloatArray:
        taken = np.interp(at - shift, nominal, shared * mean + sign * play * apart)
        return np.asarray(axis(at, sign) - taken)

    return move


@pytest.mark.parametrize("noise", [0.05, 0.3])
@pytest.mark.parametrize(
    ("how", "acts", "said"),
    [
        ((1, 1), "held", ()),
        ((-1, -1), "wrong-sign", ("Enter every value with the other sign",)),
        ((2, 2), "double", ("Leave it in once; where it is, enter half of every value",)),
        ((0, 0), "not-in-effect", ("In the section of the joint state COMP_FILE", "start LinuxCNC again")),
        ((1, -1), "play-turned", ("Enter the values of moving forward where those of moving back stand",)),
        ((1, 2), "play-twice", ("set the control's backlash parameter to 0",)),
        ((1, 0), "play-left", ("Switch on compensation in both directions",)),
        ((1, 1, 50), "shifted", ("its rows are 50 mm apart", "instead of 0 mm")),
        ((1, 1, -100), "shifted", ("its rows are 50 mm apart", "instead of 0 mm")),
        ((0.75, 0.75), "other", ()),
    ],
)
def test_a_table_that_a_control_applies_in_another_way_is_told_with_what_to_enter(
    capsys: Capture, how: tuple[float, ...], acts: str, said: tuple[str, ...], noise: float
) -> None:
    measure("before", axis, noise=noise)
    assert main(["compensate", "before.yaml", "--controller", "linuxcnc", "-o", "out"]) == 0
    measure("after", apply(np.loadtxt("out/before.comp"), *how), noise=noise, seed=7)
    code, values, text = confirm(capsys, "linuxcnc")
    assert (code, values["acts"]) == (0 if acts == "held" else 1, acts)
    assert all(each in text for each in said)
    assert ("as it was made," in text) is (acts not in {"held", "other"})
    assert (values["rest"]["as_it_acts"] < values["rest"]["as_made"] / 3) is (acts not in {"held", "other"})
    assert values["shift"] == pytest.approx(how[2] if len(how) > 2 else 0.0, abs=4 * noise / 0.05**0.5)


def test_what_the_backlash_parameter_will_leave_is_told_with_the_table(capsys: Capture) -> None:
    measure("before", axis, noise=0.0)
    assert main(["compensate", "before.yaml", "--controller", "etalon", "--unconfirmed"]) == 0
    text = " ".join(capsys.readouterr().out.split())
    assert (
        "4.00 µm (forward − reverse), is left to the control's backlash parameter. With that E is 0.00 µm."
        in text
    )


def test_a_table_within_the_scatter_is_no_failure_and_not_said_to_act(capsys: Capture) -> None:
    for name, seed in (("before", 3), ("after", 4)):
        measure(name, lambda at, _: 0 * at, seed=seed)
    code, values, text = confirm(capsys, "linuxcnc")
    assert (code, values["verdict"], values["applied_uncertainty"]) == (0, "held", None)
    assert "What part of the table acts does not show" in text
    assert "% of the table" not in text


def test_a_constant_that_is_taken_out_is_nowhere_what_is_left(capsys: Capture) -> None:
    measure("before", lambda at, sign: 80 + axis(at, sign), noise=0.0)
    arguments = ["compensate", "before.yaml", "--controller", "mitsubishi", "--unconfirmed"]
    assert main([*arguments, "--json"]) == 0
    values = json.loads(capsys.readouterr().out)["forecast"]
    rows = axis(TARGETS, 1) - PLAY / 2
    taken = np.round((rows - rows[0]) * 2) / 2
    off = np.mean(taken - rows)
    left = max(np.abs(axis(TARGETS, sign) - taken + off).max() for sign in (1, -1))
    assert values["between_grid_points"]["largest"] == pytest.approx(left, abs=1e-3)


def test_rows_that_end_before_the_targets_say_so(capsys: Capture) -> None:
    measure("before", axis)
    arguments = ["compensate", "before.yaml", "--controller", "linuxcnc"]
    for step, is_said in (("45", True), ("50", False)):
        assert main([*arguments, "--step", step]) == 0
        said = " ".join(capsys.readouterr().out.split())
        assert ("The rows end at 495 mm, the targets at 500 mm" in said) is is_said


def test_what_no_target_reached_is_not_forecast(capsys: Capture) -> None:
    measure("before", axis)
    job = Path("before.yaml").read_text("utf-8")
    for travel, is_said in (("[-10, 510]", True), ("[0, 500]", False)):
        stated = job.replace("name: X,", f"name: X, travel: {travel},")
        Path("before.yaml").write_text(stated, encoding="utf-8")
        assert main(["compensate", "before.yaml", "--controller", "linuxcnc"]) == 0
        said = " ".join(capsys.readouterr().out.split())
        assert (
            "The axis goes from −10 mm to 510 mm: beyond the targets nothing was measured" in said
        ) is is_said


def test_lines_that_miss_nothing_are_not_said_to_miss_zero(capsys: Capture) -> None:
    measure("before", axis)
    assert main(["compensate", "before.yaml", "--controller", "linuxcnc"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "11 rows at the targets. U of a mean" in said
    assert "Anywhere between the 11 rows less than 0.01 µm is left" in said
