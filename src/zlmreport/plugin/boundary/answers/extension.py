"""Checks what the methods of an extension answer."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from zlmreport.document.certificate.conditions import Described
from zlmreport.evaluation.uncertainty.budget import Contribution
from zlmreport.job.keys import JobKeys
from zlmreport.language import Words
from zlmreport.plugin.boundary import Guarded
from zlmreport.plugin.boundary.answers.required import accept_all_of, accept_one_or_none, require_kind
from zlmreport.plugin.extending import ExtensionPlan, LiveRun


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


def completed(_extension: Guarded, answer: Any, *_: Any) -> Any:
    """Refuse what are no keys."""
    return require_kind(JobKeys, answer)


#: What is made of an answer, by method.
ACCEPTED: Mapping[str, Callable[..., Any]] = {
    "contributions": accept_all_of(Contribution),
    "doubts": accept_all_of(Words),
    "described": accept_one_or_none(Described),
    "contradictions": accept_all_of(tuple),
    "completed": completed,
    "plan": plan,
    "live": live,
}
