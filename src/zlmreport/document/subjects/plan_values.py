"""A plan as plain values, as ``zlmreport plan --json`` prints it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from zlmreport.job.job import Job
from zlmreport.language import Language, Words
from zlmreport.language.formatting import HELD
from zlmreport.measurement.axis import Axis
from zlmreport.model.effects.effect import find_unit_of
from zlmreport.model.planning.planned_test import PlannedTest
from zlmreport.model.planning.targets import convert_to_users_unit
from zlmreport.model.planning.visibility import Remedy, SeenEffect

SCHEMA = "zlmreport/plan/1"


def plan_values(job: Job, planned: PlannedTest, written: Sequence[Path] = ()) -> dict[str, Any]:
    """Return a plan as plain values for JSON."""
    axis, proposal = job.axis, planned.proposal
    plan, position = proposal.plan, axis.position_unit
    targets = convert_to_users_unit(axis, plan.targets)
    return {
        "schema": SCHEMA,
        "certificate": {"number": job.keys.certificate.number},
        "axis": {"name": axis.name, "kind": axis.kind.value},
        "units": {"position": position.ascii, "deviation": axis.deviation_unit.ascii, "time": "s"},
        "method": plan.method.value,
        "runs": plan.runs,
        "overrun": round(position.from_si(plan.overrun), 9),
        "feed_per_minute": round(position.from_si(plan.feed) * 60, 9),
        "dwell": plan.dwell,
        "seed": proposal.seed if proposal.has_fractions else None,
        "assumed": sorted(proposal.assumed),
        "expected": {
            "repeatability": axis.deviation_unit.from_si(proposal.expected.sigma),
            "temperature_change": proposal.expected.temperature_change,
        },
        "travelled": position.from_si(planned.travelled),
        "duration": planned.duration,
        "targets": targets,
        "two_phases_of": [_say(period) for period in planned.half_seen],
        "visits": [
            {
                "target": targets[visit.target],
                "direction": visit.approach.sign,
                "run": visit.run,
                "time": time,
            }
            for visit, time in zip(planned.visits, planned.design.time.tolist(), strict=True)
        ],
        "model": list(planned.model.identifiers),
        "visibility": [
            _collect_seen_effect(each, planned.remedies.get(each.effect.identifier), axis)
            for each in planned.seen_effects
        ],
        "log": [{"column": column, "effects": names} for column, names in planned.logs.items()],
        "requirements": [
            {
                "standard": designation,
                "requirement": _say(finding.requirement),
                "found": _say(finding.found),
                "met": finding.met,
            }
            for designation, findings in planned.findings.items()
            for finding in findings
        ],
        "files": [str(path) for path in written],
    }


def _collect_seen_effect(found: SeenEffect, remedy: Remedy | None, axis: Axis) -> dict[str, Any]:
    seen = found.visibility
    smallest = None
    if seen.smallest is not None and math.isfinite(seen.smallest[1]):
        parameter, value = seen.smallest
        unit = find_unit_of(parameter.dimension, axis.kind)
        smallest = {"name": parameter.name, "value": value * unit.per_si, "unit": unit.ascii}
    return {
        "effect": seen.effect,
        "sight": found.sight.value,
        "share": seen.share,
        "smallest_rms": axis.deviation_unit.from_si(seen.smallest_rms)
        if math.isfinite(seen.smallest_rms)
        else None,
        "smallest": smallest,
        "log": list(found.logs),
        "reason": None if seen.reason is None else _say(seen.reason),
        "remedy": None
        if remedy is None
        else {
            "reason": None if remedy.reason is None else _say(remedy.reason),
            "advice": _say(remedy.advice),
            "share": remedy.share,
        },
    }


def _say(words: Words | str) -> str:
    text = words if isinstance(words, str) else words.in_language(Language.ENGLISH)
    return text.replace(HELD, " ")
