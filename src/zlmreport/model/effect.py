"""What an effect is: one physical cause of deviations, on a page of its own."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import Any, Protocol, runtime_checkable

import numpy as np

from zlmreport.job.types import Options
from zlmreport.language import Words
from zlmreport.measurement.axis import Axis
from zlmreport.model.design import Design
from zlmreport.model.parameter import Parameter
from zlmreport.quantities.arrays import FloatArray


class Shape(Enum):
    """Along what an effect changes; effects of like shape are each other's likeliest mistakes."""

    POSITION = "position"
    DIRECTION = "direction"
    TIME = "time"
    RUN = "run"


@dataclass(frozen=True, slots=True)
class Confusion:
    """Another effect that looks alike in the residuals, and the measurement that would tell them apart."""

    effect: str
    told_apart_by: Words


@runtime_checkable
class Effect(Protocol):
    """A cause of deviations: x = Σ γ_k · column_k(design; θ).

    The same object serves fit, search, simulation, visibility of a plan, and documentation. Subclass it: then
    only what differs from the simplest effect need be said (no θ, no keys, no condition).

    Attributes
    ----------
    identifier
        As jobs name it: ``backlash``.
    title
        In words.
    equation
        In notation.
    linear
        The parameters γ, one for each column, in the order of the columns.
    searched
        The parameters θ on which the columns depend nonlinearly; empty for most effects.
    shape
        Along what it changes.
    look
        What it looks like in the residuals.
    confusions
        What it is taken for, nearest first.
    contains
        Effects whose columns are always among its own: they cannot stand beside it in a model.
    options
        Its job keys beside the names of its parameters; plain `Options` for none. A key chooses between
        forms of the effect that differ in kind (the order of a polynomial), a parameter is a quantity.
    settings
        The values of these keys in this form of the effect.
    """

    identifier: str
    title: Words
    equation: str
    linear: tuple[Parameter, ...]
    searched: tuple[Parameter, ...] = ()
    shape: Shape
    look: Words
    confusions: tuple[Confusion, ...] = ()
    contains: tuple[str, ...] = ()
    options: type[Options] = Options
    settings: Options = Options()

    def with_settings(self, settings: Any) -> Effect:  # noqa: ARG002 - this one has no keys
        """Return the form of the effect that its job keys ask for."""
        return self

    def forms(self) -> tuple[Effect, ...]:
        """Return the forms in which a comparison tries the effect; of most effects there is one."""
        return (self,)

    def untestable(self, design: Design) -> Words | None:  # noqa: ARG002 - this one needs nothing
        """Return why the effect cannot be tested on this design (what it needs), or None if it can."""
        return None

    def grid(self, design: Design) -> FloatArray:  # noqa: ARG002 - this one has no θ
        """Return the values of θ that the search begins with, shape (g, len(searched)); (1, 0) without θ.

        A single row means that θ is known beforehand (a pitch that the job states): it need not be searched.
        """
        return np.empty((1, 0))

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return the columns for one θ, shape (N, len(linear)), SI deviation for unit γ.

        A row depends on its own reading, on the axis and on `Design.span`, never on other readings: so the
        model answers between the targets and on another day.
        """

    def expected(self, axis: Axis) -> dict[str, float]:  # noqa: ARG002 - of this one nothing is known
        """Return values of parameters that follow from the job (a stated Abbe offset), SI; mostly empty."""
        return {}
