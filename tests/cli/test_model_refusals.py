"""``zlmreport model``: what makes no sense is refused with a message, and the job is left as it is."""

from __future__ import annotations

from pathlib import Path

import pytest

from cli.commands import Shop
from cli.model_jobs import change, keep, opened
from environments import ROOT
from model.hidden_effect import LAST


@pytest.fixture
def shop(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Shop:
    return opened(tmp_path, monkeypatch, capsys)


def refused(shop: Shop, *arguments: str) -> str:
    """Return the message of a command that is wrong, which leaves the job as it is."""
    before = (shop.folder / "job.yaml").read_bytes()
    run = shop.run("model", *arguments)
    assert (run.code, run.output) == (2, "")
    assert (shop.folder / "job.yaml").read_bytes() == before
    assert run.messages.count("\n") == 1
    return run.messages.strip()


@pytest.mark.parametrize("action", ["fit", "history"])
def test_a_job_without_effects_is_told_how_to_begin(shop: Shop, action: str) -> None:
    change(shop, (f"    - offset\n    - scale-error\n{LAST}", ""), ("effects:", "effects: []"))
    assert refused(shop, action, "job.yaml").endswith("begin with: zlmreport model add job.yaml offset")


def test_where_no_effect_acts_on_what_was_measured_none_is_proposed_to_begin_with(shop: Shop) -> None:
    change(
        shop,
        (f"    - offset\n    - scale-error\n{LAST}", ""),
        ("effects:", "effects: []"),
        ("measurement:\n", "measurement:\n  error: EAX\n"),
        ("iso230-2:2014", "iso230-1:2012"),
    )
    message = refused(shop, "fit", "job.yaml")
    assert message == refused(shop, "diagnose", "job.yaml")
    assert message.endswith("no installed effect acts on that; a formula of your own does: model.candidates")


def test_a_circle_is_sent_to_the_model_of_its_machine(shop: Shop) -> None:
    run = shop.run("model", "diagnose", str(ROOT / "configs/circle/certificate.yaml"))
    assert (run.code, run.output) == (2, "")
    assert "found by 'zlmreport machine diagnose', from a machine file" in run.messages


def test_an_unknown_effect_is_answered_with_the_nearest(shop: Shop) -> None:
    assert "did you mean 'screw-pitch'?" in refused(shop, "add", "job.yaml", "screwpitch")


@pytest.mark.parametrize(
    ("formula", "said"),
    [
        ("amplitud*sin(2*pi*P/L)", "amplitud is read as a logged column: did you mean amplitude?"),
        ("amplitude*sin(2*pi*P/L) + amplitud", "read as a logged column: did you mean amplitude?"),
        ("amplitude*sin(2*pi*p/L)", "p is read as a logged column: did you mean P?"),
        ("amplitude*sin(2*pi*P/Length)", "L does not stand in it; Length is read as a logged column"),
        ("amplitude*sin(2*pi*P/L)*rate(axis_temprature)", "did you mean axis_temperature?"),
        ("amplitude*sin(2*pi*P/L)*axis_temprature", "the readings; did you mean axis_temperature?"),
        ("amplitude*sin(2*pi*P/L)*amplitud", "was logged beside the readings; did you mean amplitude?"),
        ("amplitude*sin(2*pi*P/L)*oil", "no column oil was logged beside the readings"),
    ],
)
def test_a_misspelled_name_of_a_formula_is_answered_with_the_nearest(
    shop: Shop, formula: str, said: str
) -> None:
    parameters = "{amplitude: {unit: um, range: [-9, 9]}, L: {unit: mm, range: [20, 80]}}"
    own = f'    - {{name: my-wave, formula: "{formula}", parameters: {parameters}}}\n'
    change(shop, (LAST, own))
    assert refused(shop, "fit", "job.yaml").endswith(said)


def test_an_effect_of_a_number_that_nothing_counts_is_told(shop: Shop) -> None:
    assert "no plugin provides effect 'scale-joint-9" in refused(
        shop, "add", "job.yaml", f"scale-joint-{'9' * 5000}"
    )


def test_an_effect_that_is_there_already_is_refused_where_it_stands(shop: Shop) -> None:
    assert refused(shop, "add", "job.yaml", "backlash") == (
        "job.yaml:25:7: backlash stands in the model already"
    )


def test_an_effect_without_its_condition_is_refused_with_the_column(shop: Shop) -> None:
    table = shop.folder / "x-axis.csv"
    text = table.read_text(encoding="utf-8")
    table.write_text(text.replace("screw_temperature", "nut_temperature"), encoding="utf-8")
    assert refused(shop, "add", "job.yaml", "screw-expansion") == (
        "job.yaml:22:3: screw-expansion cannot be fitted to these readings: no column screw_temperature was "
        "logged beside the readings"
    )


def test_effects_that_collide_are_named(shop: Shop) -> None:
    assert "scale-error and cosine-error" in refused(shop, "add", "job.yaml", "cosine-error")


def test_an_effect_that_stands_within_another_is_refused(shop: Shop) -> None:
    shop.run("model", "add", "job.yaml", "polynomial: {order: 5}")
    assert "polynomial contains offset" in refused(shop, "add", "job.yaml", "offset")


def test_an_effect_that_explains_nothing_is_refused(shop: Shop) -> None:
    message = refused(shop, "add", "job.yaml", "screw-pitch: {sine: -2.0, cosine: 2.0}")
    assert message.startswith("job.yaml:22:3: screw-pitch explains nothing here: the error would be ")
    assert message.endswith("the job was left as it is")


def test_too_few_readings_are_refused(shop: Shop) -> None:
    change(shop, (LAST, ""))
    keep(shop, readings=2)
    assert refused(shop, "diagnose", "job.yaml") == (
        "job.yaml:22:3: the model has 2 parameters to estimate and the test 2 readings; measure more, or "
        "take effects out"
    )


def test_an_effect_that_is_not_in_the_model_cannot_be_taken_out(shop: Shop) -> None:
    message = refused(shop, "remove", "job.yaml", "backlas")
    assert message.startswith(
        "job.yaml:22:3: 'backlas' does not stand in the model; did you mean 'backlash'?"
    )


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["ad", "job.yaml", "abbe"], "unknown action 'ad'; did you mean 'add'?"),
        (["add", "job.yaml"], "add needs the name of an effect"),
        (["remove", "job.yaml", " "], "remove needs the name of an effect"),
        (["fit", "job.yaml", "abbe"], "fit takes no effect, but 'abbe' is given"),
        (["add", "job.yaml", "a: [", "--json"], "a value is expected here"),
    ],
)
def test_a_command_line_that_makes_no_sense_is_refused(
    shop: Shop, arguments: list[str], message: str
) -> None:
    assert message in refused(shop, *arguments)
