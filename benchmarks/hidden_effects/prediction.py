"""The error on a second test of the same axis, before and after adding, and that of an oracle.

The oracle knows which effect was hidden, in which form, and not its parameters: it adds this one to the job's
model, and fits.

The error is that against the true deviation, without the scatter of readings: what a compensation or a
certificate built on the model would be off.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from hidden_effects.trial import Measured, Trial
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis, DiagnosisVerdict
from zlmreport.model.effects.effect import Effect
from zlmreport.model.effects.model_error import ModelError
from zlmreport.model.fitting.fit import Fit, fit
from zlmreport.model.fitting.observations import Observations, make_observations_of


def errors(trial: Trial, diagnosis: AxisDiagnosis) -> dict[str, float]:
    """Return the errors on a second test over σ: ``before``, ``after``, and the ``oracle``'s.

    A user adds the first candidate where the verdict is that an effect is missing, and nothing otherwise.
    """
    again = trial.again()
    before = _error(diagnosis.fit, trial, again)

    def after(effect: Effect) -> float:
        try:
            return _error(_with(diagnosis.fit, effect), trial, again)
        except ModelError:  # the readings that show it were set aside
            return before

    truth = trial.effects[0].effect
    found = {"before": before, "oracle": after(truth)}
    added = diagnosis.candidates[0].effect if diagnosis.verdict is DiagnosisVerdict.MISSING else None
    if added is None:
        return found | {"after": before}
    if (added.identifier, added.settings) == (truth.identifier, truth.settings):
        return found | {"after": found["oracle"]}
    return found | {"after": after(added)}


def seen_again(trial: Trial, again: Measured) -> Observations:
    """Return the second test as a model is asked about it: with the travel of the first."""
    seen = make_observations_of(again.measurements, overrun=trial.description.plan.overrun)
    return replace(seen, design=replace(seen.design, span=trial.first.design.span))


def _with(before: Fit, effect: Effect) -> Fit:
    return fit(before.model.with_effect(effect), before.design, before.deviation)


def _error(fitted: Fit, trial: Trial, again: Measured) -> float:
    seen = seen_again(trial, again)
    design = replace(seen.design, span=fitted.design.span)
    truth = (again.known + again.hidden)[seen.reading]
    difference = fitted.predict(design).deviation - truth
    return float(np.sqrt(np.mean(difference**2))) / trial.sigma
