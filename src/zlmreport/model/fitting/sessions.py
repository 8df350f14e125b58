"""Several tests of one axis in one fit: what they share, and the zero of each.

A row of an effect's columns depends on its own reading alone. So the readings of several tests stand below
one another, and an effect has the same parameters in all of them: what one temperature leaves open, two
decide. Each test keeps its own clock, its own slow drift, and its own zero, for the instrument was set up
anew; what is irregular along the axis is the axis's own and the same in all of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from zlmreport.language import Words
from zlmreport.measurement.arrays import FloatArray, read_only_floats, read_only_integers
from zlmreport.model.effects.axis_model import AxisModel, Term
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Dimension, Effect, Parameter, Shape
from zlmreport.model.effects.model_error import ModelError
from zlmreport.model.fitting.observations import Observations

_HELD_TOGETHER = Words(
    "Session {number}, {name}: runs {first} to {last}; its zero is its own, all else is common."
)
_NOT_IN_ALL = Words("Not every session logged {conditions}: the model does without.")
_MEANING = Words("zero of session {number} against the first")


class SessionZeros(Effect):
    """The zero of each session after the first, against that of the first."""

    identifier = "session-zero"
    title = Words("Zero of each session")
    equation = "O_{s}"
    shape = Shape.POSITION  # alike in all readings of the test that a table is made from
    look = Words("Each session is displaced as a whole.")

    def __init__(self, sessions: int) -> None:
        self.linear = tuple(
            Parameter(
                f"session_{number}", f"O_{{{number}}}", Dimension.DEVIATION, _MEANING.given(number=number)
            )
            for number in range(2, sessions + 1)
        )

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return one column for each session after the first: 1 in its readings."""
        later = np.arange(1, len(self.linear) + 1)
        return np.asarray(design.session[:, np.newaxis] == later, dtype=np.float64)


def add_zeros(model: AxisModel, design: Design) -> AxisModel:
    """Return a model in which each session of a design has its own zero before anything else."""
    sessions = int(design.session.max()) + 1
    return AxisModel((Term(SessionZeros(sessions)), *model.terms)) if sessions > 1 else model


def join_sessions(own: Observations, others: Sequence[tuple[str, Observations]]) -> Observations:
    """Return the readings of several tests below one another.

    Targets are numbered anew, equal positions alike; readings of other sessions have the place −1.

    `others`: The further sessions, each with a name for the remarks.

    Raises `ModelError` if some sessions tell their times and others do not.
    """
    if not others:
        return own
    observed = [own, *(each for _, each in others)]
    designs = [each.design for each in observed]
    counted = [name for name, each in others if each.design.time_is_counted != own.design.time_is_counted]
    if counted:
        sentence = (
            f"{counted[0]} and the job must both have a time with every reading, or neither: time constants "
            "count in seconds with it and in readings without"
        )
        raise ModelError([sentence])
    names = set.intersection(*({*each.conditions} for each in designs))
    dropped = sorted(set.union(*({*each.conditions} for each in designs)) - names)

    def join(name: str) -> FloatArray:
        return np.concatenate([getattr(each, name) for each in designs])

    position = join("position")
    session = np.repeat(np.arange(len(designs)), [len(each.position) for each in designs])
    spans = np.array([each.span for each in designs])
    design = replace(
        own.design,
        position=read_only_floats(position),
        direction=read_only_floats(join("direction")),
        run=read_only_integers(join("run")),
        target=read_only_integers(np.unique(position, return_inverse=True)[1]),
        time=read_only_floats(join("time")),
        since_reversal=read_only_floats(join("since_reversal")),
        conditions={
            name: read_only_floats(np.concatenate([each.conditions[name] for each in designs]))
            for name in own.design.conditions
            if name in names
        },
        span=(float(spans[:, 0].min()), float(spans[:, 1].max())),
        session=read_only_integers(session),
    )
    remarks = [each for each in own.remarks if all(each in one.remarks for one in observed)]
    remarks += [
        Words("Session {number}: {remark}").given(number=number, remark=each)
        for number, one in enumerate(observed, start=1)
        for each in one.remarks
        if each not in remarks
    ]
    for number, (name, _) in enumerate(others, start=1):
        runs = design.cycle[session == number]
        first, last = int(runs.min()), int(runs.max())
        remarks.append(_HELD_TOGETHER.given(number=number + 1, name=name, first=first, last=last))
    if dropped:
        remarks.append(_NOT_IN_ALL.given(conditions=", ".join(dropped)))
    return Observations(
        design,
        read_only_floats(np.concatenate([each.deviation for each in observed])),
        read_only_integers(
            np.concatenate([own.reading, *(np.full(len(e.reading), -1) for e in observed[1:])])
        ),
        tuple(remarks),
    )
