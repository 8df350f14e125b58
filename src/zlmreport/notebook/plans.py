"""A test before it is done, for notebooks: where the axis goes, for how long, and what cannot be seen."""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from zlmreport import pipeline
from zlmreport.document.figures.sequence import draw_sequence
from zlmreport.document.subjects.plan import plan_sections, plan_values
from zlmreport.errors import InputError, Place, Problem, count_in_words
from zlmreport.job.job import Job
from zlmreport.job.loading import load
from zlmreport.language import Language
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.measurement.measurand import is_for
from zlmreport.measurement.units import SECONDS_PER_MINUTE
from zlmreport.model.planning.planned_test import describe_planned_test
from zlmreport.model.planning.programs import plan_motion_of
from zlmreport.model.planning.visibility import Sight
from zlmreport.notebook.frames import Library, frame_of
from zlmreport.notebook.layout import sections_html
from zlmreport.notebook.readings import plain_value, registry
from zlmreport.notebook.results import draw_on

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_NAME = "plan"
_NO_TARGETS = (
    "a circular test has a path and no targets; zlmreport plan prints it and writes its part programs"
)
#: How far a plan sees an effect that is not hidden, or that this axis cannot have.
_SEEN_OR_ELSEWHERE = frozenset({Sight.VISIBLE.value, Sight.OTHER_AXIS.value})
#: What a plan needs of a job that nobody has written yet.
_UNSTATED: Mapping[str, Any] = {
    "schema": "zlmreport/job/1",
    "certificate": {"number": "plan", "kind": "report"},
    "evaluate": ["iso230-2:2014"],
}
_SOURCE = {"plugin": "laser-csv", "file": "readings.csv"}


class Plan:
    """A planned test: ``plan.targets``, ``plan.to_frame()``, ``plan.minutes``, ``plan.hidden``."""

    def __init__(self, job: Job) -> None:
        if job.axis.circle:
            raise InputError.at(job.place_of("circle"), _NO_TARGETS)
        effects = [each for each in registry().effects if is_for(each, job.axis.measurand)]
        planned = describe_planned_test(job, pipeline.choose_standards(job, registry()), effects)
        plan = planned.proposal.plan
        self._values = plan_values(job, planned)
        self._sections = plan_sections(job, planned, Language.ENGLISH)
        self._sequence = draw_sequence(
            plan_motion_of(job.keys.certificate.number, job.axis, plan, job.place_of("plan"))
        )

    @cached_property
    def targets(self) -> FloatArray:
        """The target positions, rising, mm or degrees."""
        return read_only_floats(np.array(self._values["targets"], dtype=np.float64))

    @property
    def method(self) -> str:
        """The positioning method: ``linear``, ``pendulum`` and so on."""
        return str(self._values["method"])

    @property
    def runs(self) -> int:
        """Readings of each target in each direction."""
        return int(self._values["runs"])

    @property
    def minutes(self) -> float:
        """How long it takes, motion and rest together."""
        return float(self._values["duration"]) / SECONDS_PER_MINUTE

    @property
    def hidden(self) -> dict[str, str]:
        """The installed effects that this test would not see, each with why."""
        return {
            each["effect"]: each["reason"] or (each["remedy"] or {}).get("reason") or each["sight"]
            for each in self._values["visibility"]
            if each["sight"] not in _SEEN_OR_ELSEWHERE
        }

    def to_frame(self, library: Library | None = None) -> Any:
        """Return the visits in their order: target (mm or °), direction, run, time (s).

        `library`: Of the frame: ``pandas``, ``polars`` or ``pyarrow``; without it the one that is there.
        """
        visits = self._values["visits"]
        columns = {name: np.array([visit[name] for visit in visits]) for name in visits[0]}
        return frame_of(columns, library)

    def to_dict(self) -> dict[str, Any]:
        """Return the plan as ``zlmreport plan --json`` prints it."""
        return dict(self._values)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the way of the axis over the visits on axes of matplotlib, and return them."""
        return draw_on(self._sequence, ax)[0]

    def __repr__(self) -> str:
        """Return how large the test is."""
        targets, runs = count_in_words(len(self.targets), "target"), count_in_words(self.runs, "run")
        return f"<Plan: {targets}, {runs}, {self.method}, {self.minutes:.0f} min>"

    def _repr_html_(self) -> str:
        return sections_html(self._sections)


def plan(job: str | Path | None = None, **keys: Any) -> Plan:
    """Plan a test: of a job, whose readings need not exist, or of its keys.

    Parameters
    ----------
    job
        A job (``job.yaml``).
    **keys
        Keys of a job instead: ``axis``, ``measurement`` (``{"method": "pendulum", "feed": 2000}``), ``plan``,
        ``evaluate``, ``model``. Without ``evaluate`` the test is planned for ISO 230-2:2014.

    Raises
    ------
    InputError
        With all that is wrong with the job or the keys; if the targets cannot be planned.
    AccessError
        If the job cannot be read.

    Examples
    --------
    >>> import zlmreport as z
    >>> planned = z.plan(axis={"name": "X", "travel": [0, 500]}, plan={"targets": {"count": 6}, "runs": 5})
    >>> len(planned.targets), planned.runs, len(planned.to_frame())
    (6, 5, 60)
    """
    if job is not None:
        if keys:
            raise InputError.at(Place(_NAME), f"the job states {next(iter(keys))!r} itself; change it there")
        return Plan(load(Path(job), registry()))
    measurement = keys.get("measurement", {})
    if isinstance(measurement, Mapping):
        measurement = {"source": _SOURCE, **measurement}
    content = json.dumps({**_UNSTATED, **keys, "measurement": measurement}, default=plain_value)
    try:
        return Plan(load(Path(_NAME), registry(), content=content.encode()))
    except InputError as error:
        raise InputError(Problem(Place(_NAME), each.message) for each in error.problems) from error
