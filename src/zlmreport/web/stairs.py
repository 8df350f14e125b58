"""A built model as a staircase: what would come in or go out, and how far the error falls.

Nothing of it stands in the job: a step is taken by a click, as any other change of the model.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

from zlmreport.document.subjects.fit import write_deviation
from zlmreport.errors import ZlmreportError
from zlmreport.job.job import Job
from zlmreport.language import Language, list_alternatives
from zlmreport.measurement.units import with_unit
from zlmreport.plugin.registry import Registry
from zlmreport.web.naming import Naming


def make_stairs(
    steps: Sequence[Mapping[str, Any]], job: Job, registry: Registry, names: Naming
) -> list[dict[str, Any]]:
    """Return the steps of a build as a page shows them.

    `steps`: As ``zlmreport model build --json`` has them, errors in the unit of the job's deviations.
    """
    unit, language = job.axis.deviation_unit, names.language
    largest = max((each["rms_before"] for each in steps), default=0.0) or 1.0

    def written(value: float | None) -> str:
        number = write_deviation(None if value is None else unit.to_si(value), job.axis, language)
        return with_unit(number, unit.symbol)

    def stair(each: Mapping[str, Any]) -> dict[str, Any]:
        removed = bool(each.get("removed"))
        noise = each["noise_rms"]
        return {
            "effect": each["effect"],
            "argument": _write_argument(each["effect"], each["settings"], job, registry),
            "removed": removed,
            "name": f"{'−' if removed else '+'} {_name_one_of(each, names)}",
            "before": written(each["rms_before"]),
            "after": written(each["rms_after"]),
            "share": each["rms_after"] / largest,
            "floor": None if noise is None else min(1.0, noise / largest),
        }

    return [stair(each) for each in steps]


def _name_one_of(step: Mapping[str, Any], names: Naming) -> str:
    """Return the effect of a step, with those that the readings do not tell from it."""
    titles = [names.name_in(each) for each in (step["effect"], *step.get("indistinguishable_from", ()))]
    return list_alternatives(titles).in_language(names.language)


def _write_argument(effect: str, settings: Mapping[str, Any], job: Job, registry: Registry) -> str:
    """Return an effect as a job names it: a formula of its candidates by name, else with unusual keys."""
    if effect in {each.identifier for each in job.candidates}:
        return effect
    try:
        usual = registry.effect(effect).settings.model_dump(mode="json")
    except ZlmreportError:  # one that stands there several times has a number that no plugin knows
        usual = {}
    unusual = {key: value for key, value in settings.items() if key not in usual or usual[key] != value}
    return f"{effect}: {json.dumps(unusual)}" if unusual else effect


def add_stairs(state: dict[str, Any], job: Job, registry: Registry, language: Language) -> dict[str, Any]:
    """Return the state of a build with its staircase; any other state as it is."""
    steps = state.get("values", {}).get("steps")
    if steps is None:
        return state
    return {**state, "stairs": make_stairs(steps, job, registry, Naming.of(registry.effects, language))}
