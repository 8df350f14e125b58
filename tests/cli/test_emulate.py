"""``zlmreport emulate``: an instrument that is not there."""

from __future__ import annotations

import os
from itertools import islice
from pathlib import Path

import pytest

from processes import ZLMREPORT, run, started
from zlmreport.cli import main
from zlmreport.plugin.registry import find_plugins


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["umd1", "--fault", "lost-beam@3", "--dwell", "x"], "'x' is no number"),
        (["no-such"], "no plugin provides instrument 'no-such'"),
        (["umd1", "--fault", "lost-baem@3"], "did you mean 'lost-beam'?"),
        (["umd1", "--fault", "lost-beam"], "does not say when"),
        (["umd1", "--course", "0,x"], "'x' is no position"),
        (["umd1", "--dwell", "x"], "'x' is no number; write one, such as 5"),
        (["umd1", "--port", "70000"], "is no TCP port"),
        (["umd1", "--port", "9" * 5000], "'… (5,000 characters) is no TCP port"),
        (["umd1", "--dwell", "-1"], "--dwell -1 makes no axis"),
        (["umd1", "--link", "a", "--port", "0"], "take one"),
        ([], "INSTRUMENT"),
    ],
)
def test_a_mistake_is_told_and_nothing_begins(
    arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["emulate", *arguments]) == 2
    assert message in capsys.readouterr().err


def test_a_link_that_is_taken_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["emulate", "umd1", "--link", str(tmp_path)]) == 3
    assert "choose another" in capsys.readouterr().err


def test_an_axis_is_described_in_millimetres(tmp_path: Path) -> None:
    link = tmp_path / "display"
    command = (*ZLMREPORT, "emulate", "nd28x", "--link", link, "--course=-5,10", "--dwell", "600")
    with started(*command) as emulation:
        *_, axis = emulation.lines(3)
        display = find_plugins().instrument("nd28x")
        with display.open(display.options.model_validate({"port": str(link)})) as connection:
            reading = next(connection.readings())
    assert axis == "axis: −5, 10 mm, 600 s at each, over and over; Ctrl-C ends\n"
    assert reading.value == pytest.approx(-5e-3, abs=1e-6)


def test_an_instrument_is_read_until_it_is_ended(tmp_path: Path) -> None:
    link = tmp_path / "umd"
    command = (*ZLMREPORT, "emulate", "umd1", "--link", link, "--course", "25")
    with started(*command) as emulation:
        printed = emulation.lines(3)
        umd = find_plugins().instrument("umd1")
        with umd.open(umd.options.model_validate({"port": str(link)})) as connection:
            readings = list(islice(connection.readings(), 10))
        emulation.ended()
    assert printed[1] == f"port: {link}\n"
    assert all(reading.is_usable for reading in readings)
    assert not os.path.lexists(link)


def test_an_instrument_that_is_unplugged_ends_the_command() -> None:
    done = run(*ZLMREPORT, "emulate", "nd28x", "--port", "0", "--fault", "unplugged@0")
    assert done.returncode == 0
    assert done.stdout.splitlines()[-1] == "unplugged"
