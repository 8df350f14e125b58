"""``zlmreport plugins`` and ``zlmreport schema``."""

from __future__ import annotations

import json

import pytest

from cli.commands import Shop, use
from offers import exemplary_registry, offering
from testing.exemplary import ExemplaryStandard
from zlmreport.job.schema import make_job_schema
from zlmreport.plugin import Words
from zlmreport.plugin.registry import Plugin, collect


def test_plugins_are_listed_by_kind_with_title_and_distribution(shop: Shop) -> None:
    run = shop.run("plugins")
    assert run.code == 0
    assert run.output.splitlines() == [
        "standards",
        "  exemplary:1  An exemplary standard  exemplary-plugins 1.2",
        "data sources",
        "  exemplary-text  Six numbers in a line  exemplary-plugins 1.2",
        "formats",
        "  exemplary  Words in JSON  exemplary-plugins 1.2",
        "effects",
        "  exemplary-wave  A wave over the travel  exemplary-plugins 1.2",
        "circle effects",
        "  none",
        "part programs",
        "  exemplary-steps  Four words  exemplary-plugins 1.2",
        "controllers",
        "  none",
        "extensions",
        "  none",
        "instruments",
        "  none",
        "notifiers",
        "  none",
    ]


def test_plugins_that_do_not_work_are_listed_with_the_reason(
    shop: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    broken = (Plugin("broken", "broken", "acme", "0.1"), offering([object()]))
    use(monkeypatch, collect([broken], disabled=["resting"]))
    run = shop.run("plugins")
    assert run.code == 0
    assert run.output.splitlines()[:2] == ["standards", "  none"]
    assert "  broken  acme 0.1  standard 'object' lacks identifier" in run.output
    assert run.output.endswith("switched off by ZLMREPORT_DISABLE_PLUGINS\n  resting\n")


def test_what_two_plugins_provide_is_listed_as_what_no_job_can_use(
    shop: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    twice = [(Plugin(name, name, "acme", "1"), offering([ExemplaryStandard()])) for name in ("one", "two")]
    use(monkeypatch, collect(twice))
    assert " ".join(shop.run("plugins").output.split()).endswith(
        "provided twice two plugins provide standard 'exemplary:1': one and two; switch one off: "
        "ZLMREPORT_DISABLE_PLUGINS=two"
    )


@pytest.mark.parametrize("columns", [60, 80])
def test_a_long_title_has_the_room_that_a_line_leaves(
    columns: int, shop: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    title = " ".join(["Accuracy and repeatability of positioning"] * 4)
    monkeypatch.setattr(ExemplaryStandard, "title", Words(title))
    monkeypatch.setenv("COLUMNS", str(columns))
    lines = shop.run("plugins").output.splitlines()
    assert max(map(len, lines)) <= columns


def test_schema_is_printed_with_the_keys_of_the_installed_plugins(shop: Shop) -> None:
    run = shop.run("schema")
    assert run.code == 0
    assert json.loads(run.output) == json.loads(json.dumps(make_job_schema(exemplary_registry())))


@pytest.mark.parametrize("command", ["plugins", "schema"])
def test_listings_take_no_arguments(command: str, shop: Shop) -> None:
    run = shop.run(command, "job.yaml")
    assert run.code == 2
    assert run.messages.startswith(f"zlmreport {command}: 'job.yaml' is one argument too many")
