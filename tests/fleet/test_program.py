"""The version of a program is its release and its code."""

from __future__ import annotations

from pathlib import Path

import pytest

from job.jobs import SOUND
from zlmreport import __version__
from zlmreport.fleet.basis import find_program_versions, name_programs_of
from zlmreport.job.loading import load
from zlmreport.plugin.registry import find_plugins

JOB = SOUND.replace("exemplary-text", "laser-csv").replace("exemplary:1", "nmtba").replace("E: 20", "P: 20")


@pytest.fixture
def plugin(tmp_path: Path) -> Path:
    """Return a plugin in a file of its own."""
    path = tmp_path / "mine.py"
    path.write_text("one = 1\n", encoding="utf-8")
    return path


def test_the_own_version_has_release_and_code() -> None:
    release, _, code = find_program_versions({})["zlmreport"].partition(" ")
    assert release == __version__
    assert len(code) == 16


def test_other_code_in_a_plugin_file_is_another_version(plugin: Path) -> None:
    before = find_program_versions({}, [plugin])
    plugin.write_text("one = 2\n", encoding="utf-8")
    after = find_program_versions({}, [plugin])
    assert before[str(plugin)] != after[str(plugin)]
    assert before["zlmreport"] == after["zlmreport"]


def test_a_plugin_that_the_environment_names_counts(plugin: Path) -> None:
    assert str(plugin) in find_program_versions({"ZLMREPORT_PLUGINS": str(plugin)})


def test_the_set_of_all_plugins_has_a_version(plugin: Path) -> None:
    assert (
        find_program_versions({})["the set of plugins"]
        != find_program_versions({}, [plugin])["the set of plugins"]
    )


def test_a_job_depends_on_what_it_names(tmp_path: Path) -> None:
    path = tmp_path / "job.yaml"
    path.write_text(JOB.replace("exemplary", "json"), encoding="utf-8")
    registry = find_plugins({})
    assert name_programs_of(load(path, registry), ("json",), registry) == {"zlmreport"}


def test_a_job_with_a_model_depends_on_every_plugin(tmp_path: Path) -> None:
    path = tmp_path / "job.yaml"
    path.write_text(JOB.replace("exemplary", "json") + "model: {effects: [offset]}\n", encoding="utf-8")
    registry = find_plugins({})
    assert "the set of plugins" in name_programs_of(load(path, registry), ("json",), registry)
