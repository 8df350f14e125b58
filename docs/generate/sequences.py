"""Pictures of the positioning methods: the same small test by each."""

from __future__ import annotations

from collections.abc import Mapping

from zlmreport.document.figures.draw import to_svg
from zlmreport.document.figures.sequence import draw_sequence
from zlmreport.language import Language
from zlmreport.model.planning.methods import Method
from zlmreport.testing import sample_motion

_TARGETS = (18.0, 57.0, 103.0, 141.0, 182.0)
_RUNS = 3
_OVERRUN = 12.0


def pictures() -> Mapping[str, str]:
    """Return the picture of each method by the name of its file."""
    return {
        f"sequence-{method.value}.svg": to_svg(
            draw_sequence(sample_motion(method, targets=_TARGETS, runs=_RUNS, overrun=_OVERRUN)),
            Language.ENGLISH,
        )
        for method in Method
    }
