"""Budgets made on the spot, in micrometres."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

from installed import registry
from plugins.standards.installed import STANDARDS
from zlmreport import pipeline
from zlmreport.evaluation.uncertainty.monte_carlo import TRIALS, Expanded, propagate
from zlmreport.plugin import MeasurementSet, same_in_all_languages
from zlmreport.plugin.extension import Acts, Contribution, Distribution, Job
from zlmreport.plugin.protocols import Standard
from zlmreport.plugin.renderer import Budget
from zlmreport.plugin.standard import evaluate

MICROMETRE = 1e-6
ISO = STANDARDS["iso230-2:2014"]
#: U of 10,000 trials scatters by 1 % (JCGM 101, 7.9.4: the quantile of a normal distribution at 95.45 % has
#: a standard uncertainty of √(p(1 − p)/M)/φ, φ its density); four times that is beyond chance.
BY_CHANCE = 0.04


def contribution(
    micrometres: float, acts: Acts, distribution: Distribution = Distribution.NORMAL
) -> Contribution:
    return Contribution(
        same_in_all_languages("any"),
        micrometres * MICROMETRE,
        acts,
        distribution,
        same_in_all_languages(""),
        same_in_all_languages(""),
    )


def make_budget_of(job: Job, measurements: MeasurementSet | None = None) -> Budget:
    """Return the budget of a job, of its own readings or of others."""
    read = pipeline.read(job, registry()) if measurements is None else measurements
    found = pipeline.make_budget_of_job(job, read, registry())
    assert isinstance(found, Budget), found
    return found


def budget(micrometres: float, acts: Acts, distribution: Distribution = Distribution.NORMAL) -> Budget:
    return Budget((contribution(micrometres, acts, distribution),))


def expanded(
    of: Budget, measurements: MeasurementSet, standard: Standard = ISO, trials: int = TRIALS
) -> Mapping[str, Expanded]:
    """Return U and k of every parameter of a standard."""
    options = standard.options()
    evaluation = evaluate(standard, measurements, options, {})
    (found,) = propagate(of, [(evaluation, partial(standard.arithmetic, options=options))], trials)
    return found


def uncertainties(
    of: Budget, measurements: MeasurementSet, standard: Standard = ISO, trials: int = TRIALS
) -> dict[str, float]:
    """Return U of every parameter of a standard, µm."""
    found = expanded(of, measurements, standard, trials)
    return {symbol: each.uncertainty / MICROMETRE for symbol, each in found.items()}
