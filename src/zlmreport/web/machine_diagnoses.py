"""The diagnosis of a machine beside its page: ``python -m zlmreport.web.machine_diagnoses MACHINE.yaml``."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from zlmreport.errors import ZlmreportError
from zlmreport.language import Language, Words
from zlmreport.language.formatting import write_percentage
from zlmreport.machines.diagnosis import (
    CircleCandidate,
    EffectStep,
    MachineDiagnosis,
    diagnose,
)
from zlmreport.machines.planning import NextRun, plan_next_run
from zlmreport.machines.subjects.findings import (
    lay_out_absence,
    lay_out_plan,
    lay_out_verdict,
    say_how_told,
    say_what_is_next,
)
from zlmreport.machines.subjects.saying import Sayer
from zlmreport.measurement.units import MICROMETRE
from zlmreport.plugin.registry import find_plugins
from zlmreport.web.blocks import collect_blocks, list_all_sections
from zlmreport.web.diagnoses import answer_all
from zlmreport.web.machine_bench import MachineBench
from zlmreport.web.machine_view import collect_parameter, name_effects
from zlmreport.web.naming import Naming

#: Probability from which on an effect is shown with all that is known of it.
_SERIOUS = 0.01


def answer(bench: MachineBench) -> dict[str, Any]:
    """Return the diagnosis of the machine in all languages, and of which content it is."""
    try:
        loaded = bench.load()
        catalogue = loaded.machine.catalogue
        diagnosis = diagnose(bench.make_study(loaded), catalogue)
        planned = plan_next_run(diagnosis, catalogue)
    except ZlmreportError as error:
        return {"problems": [str(each) for each in error.problems]}
    return {
        "content": loaded.content,
        "diagnosis": {
            language.value: _collect_diagnosis_of(diagnosis, planned, language) for language in Language
        },
    }


def _collect_diagnosis_of(
    diagnosis: MachineDiagnosis, planned: NextRun, language: Language
) -> dict[str, Any]:
    """Return a diagnosis in one language, what to do next first."""
    say = Sayer(language)
    names = name_effects(diagnosis.catalogue, language)
    verdict, *findings = lay_out_verdict(diagnosis, say).blocks
    candidates = [_make_candidate(each, diagnosis, names) for each in diagnosis.candidates]
    return {
        "verdict": diagnosis.verdict.value,
        "isTied": diagnosis.is_tied,
        "next": say(say_what_is_next(diagnosis, planned)),
        "statement": collect_blocks([verdict], names)[0]["text"],
        #: What of the error no effect takes away, once all that was found is in the model.
        "noise": None
        if diagnosis.is_tied
        else {
            "value": MICROMETRE.from_si(diagnosis.noise),
            "written": say.write_micrometres(diagnosis.noise),
        },
        "findings": collect_blocks(findings, names),
        "candidates": candidates,
        "serious": sum(each.probability > _SERIOUS for each in diagnosis.candidates),
        "notExcluded": [],
        "hidden": [
            {"effects": [name], "names": [names.name_in(name)], "reason": say(_UNSEEN)}
            for name in diagnosis.not_testable
        ],
        "remarks": [],
        "stairs": list(_list_stairs(diagnosis.steps, names)),
        "sections": list_all_sections([lay_out_absence(diagnosis, say), lay_out_plan(planned, say)], names),
    }


def _make_candidate(candidate: CircleCandidate, diagnosis: MachineDiagnosis, names: Naming) -> dict[str, Any]:
    effect, say = candidate.effect, Sayer(names.language)
    equals = candidate.indistinguishable_from
    return {
        "effect": effect.identifier,
        "name": names.name_in(effect.identifier),
        "title": say(effect.title),
        "argument": effect.identifier,
        "probability": f"{write_percentage(candidate.probability, names.language.decimal_sign)} %",
        "share": candidate.probability,
        "plausible": candidate.is_plausible,
        "p": "",
        "rmsBefore": _write_length(diagnosis.study.rms, say),
        "rmsAfter": _write_length(candidate.rms_after, say),
        "parameters": [collect_parameter(each, names.language) for each in candidate.estimates],
        "explains": say(effect.explains),
        "equals": list(equals),
        "equalNames": [names.name_in(each) for each in equals],
        "tell": f"{say(say_how_told(candidate, diagnosis))}." if equals else "",
        "remedy": "",
    }


def _list_stairs(steps: Sequence[EffectStep], names: Naming) -> Iterator[dict[str, Any]]:
    """Yield the steps by which the error falls, as a staircase shows them."""
    say = Sayer(names.language)
    largest = max((each.before for each in steps), default=0.0) or 1.0
    for each in steps:
        yield {
            "effect": each.effect,
            "argument": each.effect,
            "removed": False,
            "name": f"+ {names.name_in(each.effect)}",
            "before": _write_length(each.before, say),
            "after": _write_length(each.after, say),
            "share": each.after / largest,
            "floor": min(1.0, each.noise / largest),
        }


def _write_length(length: float, say: Sayer) -> str:
    return f"{say.write_micrometres(length)} {MICROMETRE.symbol}"


_UNSEEN = Words("these circles cannot show it")


def main() -> None:
    """Answer until nobody asks."""
    path, *plugins = map(Path, sys.argv[1:])
    bench = MachineBench(path, find_plugins(files=plugins))
    answer_all(lambda _: answer(bench))


if __name__ == "__main__":
    main()
