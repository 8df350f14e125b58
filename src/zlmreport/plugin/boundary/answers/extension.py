"""Checks what the methods of an extension answer."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from zlmreport.document.certificate.conditions import Described
from zlmreport.evaluation.uncertainty.budget import Contribution
from zlmreport.job.keys import JobKeys
from zlmreport.plugin.boundary import Guarded
from zlmreport.plugin.boundary.answers.required import require_all_of, require_kind, sentences
from zlmreport.plugin.extending import ExtensionPlan, LiveRun


def contributions(_extension: Guarded, answer: Any, *_: Any) -> Sequence[Any]:
    """Take every contribution."""
    return require_all_of(Contribution, answer)


def described(_extension: Guarded, answer: Any, *_: Any) -> Any:
    """Refuse what is no description."""
    return answer if answer is None else require_kind(Described, answer)


def plan(extension: Guarded, answer: Any, *_: Any) -> Any:
    """Hand on a plan whose files and programs are asked for through the boundary too."""
    if answer is None:
        return None
    of = require_kind(ExtensionPlan, answer)
    files = extension.look_after("files of the plan", of.files)
    return replace(of, subject=extension.look_after("subject of the plan", of.subject), files=files)


def live(extension: Guarded, answer: Any, *_: Any) -> Any:
    """Hand on readings that are taken through the boundary too."""
    if answer is None:
        return None
    of = require_kind(LiveRun, answer)
    return replace(of, run=extension.look_after("live", of.run))


def contradictions(_extension: Guarded, answer: Any, *_: Any) -> Sequence[Any]:
    """Take every contradiction now: a generator would run elsewhere."""
    return require_all_of(tuple, answer)


def completed(_extension: Guarded, answer: Any, *_: Any) -> Any:
    """Refuse what are no keys."""
    return require_kind(JobKeys, answer)


#: What is made of an answer, by method.
ACCEPTED: Mapping[str, Callable[..., Any]] = {
    "contributions": contributions,
    "doubts": sentences,
    "described": described,
    "contradictions": contradictions,
    "completed": completed,
    "plan": plan,
    "live": live,
}
