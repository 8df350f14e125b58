"""For formats of data nothing is laid out, and they say the same as beside a document."""

from __future__ import annotations

import pytest

from environments import ROOT
from installed import load_job, registry
from zlmreport import pipeline
from zlmreport.plugin.protocols import needs_layout

_DATA = ("csv", "json", "xlsx")
_TRIALS = 50


@pytest.mark.parametrize("name", ["as-found/certificate", "whole-machine/diagonals", "whole-machine/x-pitch"])
def test_data_are_those_beside_a_document(name: str) -> None:
    job = load_job(ROOT / "configs" / f"{name}.yaml", _DATA)
    alone = pipeline.compose(job, registry(), trials=_TRIALS, is_laid_out=False)
    whole = pipeline.compose(job, registry(), trials=_TRIALS)
    assert (alone.cover, alone.sections, alone.linked) == ((), (), None)
    assert whole.figures
    renderers = [registry().renderer(each) for each in _DATA]
    assert pipeline.render(alone, renderers, registry()) == pipeline.render(whole, renderers, registry())


def test_a_document_is_laid_out_whatever_is_made_beside_it() -> None:
    assert [each.identifier for each in registry().renderers if not needs_layout(each)] == list(_DATA)
    job = ROOT / "configs" / "z-axis" / "report.yaml"
    assert pipeline.run(load_job(job, ("json", "html")), registry()).certificate.sections
    assert not pipeline.run(load_job(job, ("json",)), registry()).certificate.sections


def test_of_several_measurements_neither_the_whole_nor_a_part_is_laid_out() -> None:
    job = load_job(ROOT / "configs" / "whole-machine" / "certificate.yaml", ("json",))
    made = pipeline.compose(job, registry(), trials=_TRIALS, is_laid_out=False)
    assert {(each.cover, each.sections) for each in (made, *made.parts.values())} == {((), ())}
    assert len(made.parts) == len(job.measurements)
    assert made.evaluations == tuple(one for each in made.parts.values() for one in each.evaluations)
