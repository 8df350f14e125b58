"""Which files a document carries, and in which order they are made."""

from __future__ import annotations

from pathlib import Path

import pytest

from job.jobs import SOUND
from offers import offering
from testing.exemplary import ExemplaryRenderer, ExemplarySource, ExemplaryStandard
from zlmreport import pipeline
from zlmreport.job.loading import load
from zlmreport.plugin.registry import Plugin, Registry, collect
from zlmreport.plugin.renderer import Attachment, Certificate, Relationship


class Results(ExemplaryRenderer):
    identifier = "json"
    relationship = Relationship.DATA


class Twin(ExemplaryRenderer):
    identifier = "twin"
    suffix = ".xml"
    relationship = Relationship.ALTERNATIVE


class Page(ExemplaryRenderer):
    """A renderer of a third party that knows nothing of attachments."""

    identifier = "page"
    suffix = ".html"


class Folder(ExemplaryRenderer):
    identifier = "folder"
    suffix = ".zip"
    carries_attachments = True
    received: tuple[Attachment, ...] = ()

    def render(self, certificate: Certificate) -> bytes:
        self.received = certificate.attachments
        return b"folder"


FOLDER = Folder()


def installed(*renderers: ExemplaryRenderer) -> Registry:
    return collect([(Plugin("exemplary"), offering([ExemplaryStandard()], [ExemplarySource()], renderers))])


def carried(folder: Path, formats: tuple[str, ...], registry: Registry) -> dict[str, Relationship]:
    """Run a job; return the relationships of what its folder carries."""
    (folder / "six.txt").write_text("1 2 3 -1 -2 -3")
    (folder / "job.yaml").write_text(SOUND)
    FOLDER.received = ()
    outcome = pipeline.run(load(folder / "job.yaml", registry, formats), registry)
    assert [document.path.suffix for document in outcome.documents] == [
        registry.renderer(identifier).suffix for identifier in formats
    ]
    return {each.name: each.relationship for each in FOLDER.received}


SOURCES = {"job.yaml": Relationship.SOURCE, "six.txt": Relationship.SOURCE}


def test_the_results_file_is_carried_whether_or_not_it_is_asked_for(tmp_path: Path) -> None:
    registry = installed(FOLDER, Results())
    expected = {**SOURCES, "CAL-1.json": Relationship.DATA}
    assert carried(tmp_path, ("folder",), registry) == expected
    assert carried(tmp_path, ("folder", "json"), registry) == expected


def test_another_form_of_the_certificate_is_carried_if_it_is_asked_for(tmp_path: Path) -> None:
    registry = installed(FOLDER, Results(), Twin())
    assert "CAL-1.xml" not in carried(tmp_path, ("folder",), registry)
    assert carried(tmp_path, ("folder", "twin"), registry)["CAL-1.xml"] is Relationship.ALTERNATIVE


def test_a_renderer_that_knows_nothing_of_attachments_is_neither_carried_nor_carries(tmp_path: Path) -> None:
    assert carried(tmp_path, ("page", "folder"), installed(FOLDER, Page())) == SOURCES


def test_what_is_carried_is_what_is_written(tmp_path: Path) -> None:
    registry = installed(FOLDER, Results())
    carried(tmp_path, ("json", "folder"), registry)
    (results,) = (each for each in FOLDER.received if each.name == "CAL-1.json")
    written = Results().render(pipeline.compose(load(tmp_path / "job.yaml", registry, ("json",)), registry))
    assert results.content == written
    assert results.media_type == "application/json"


def test_a_job_without_a_document_that_carries_files_makes_no_results_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def rendered(_results: Results, _certificate: Certificate) -> bytes:
        raise AssertionError("nobody asked for it")

    monkeypatch.setattr(Results, "render", rendered)
    assert carried(tmp_path, ("page",), installed(Page(), Results())) == {}
