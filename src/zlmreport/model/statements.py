"""What a diagnosis comes to, in sentences."""

from __future__ import annotations

from collections.abc import Sequence

from zlmreport.language import Words
from zlmreport.model import wording
from zlmreport.model.diagnosis import Candidate, Diagnosis, Verdict

#: Probability from which on a candidate is worth a word.
_SERIOUS = 0.01

_ADEQUATE = Words(
    en="The model describes the readings: nothing is left that their scatter does not explain.",
    de="Das Modell beschreibt die Messwerte: Es bleibt nichts übrig, was ihre Streuung nicht erklärt.",
)
_MISSING = Words(
    en="The model lacks something: {effects} explains the rest.",
    de="Dem Modell fehlt etwas: {effects} erklärt den Rest.",
)
_MISSING_TOGETHER = Words(
    en="The model lacks something: {effects} together explain the rest.",
    de="Dem Modell fehlt etwas: {effects} erklären zusammen den Rest.",
)
_UNEXPLAINED = Words(
    en="Something is left that no installed effect explains.",
    de="Es bleibt etwas übrig, das kein installierter Einfluss erklärt.",
)
_SHAPE = Words(
    en="Something is left that no installed effect explains: {shape}; root mean square {size}, largest "
    "at {where}.",
    de="Es bleibt etwas übrig, das kein installierter Einfluss erklärt: {shape}; quadratischer Mittelwert "
    "{size}, am größten bei {where}.",
)
_OR = Words(en="{one} or {other}", de="{one} oder {other}")
_AND = Words(en="{one} and {other}", de="{one} und {other}")


def verdict_statement(diagnosis: Diagnosis) -> Words:
    """Return the verdict in a sentence, with the names of what is missing or the shape of what has none."""
    if diagnosis.verdict is Verdict.ADEQUATE:
        return _ADEQUATE
    if diagnosis.verdict is Verdict.UNEXPLAINED:
        unnamed = diagnosis.unnamed
        if unnamed is None:
            return _UNEXPLAINED
        size = wording.deviation(diagnosis.fit.design.axis, unnamed.size)
        return _SHAPE.given(shape=unnamed.shape, size=size, where=unnamed.where)
    leading = diagnosis.candidates[0]
    first = listed([leading.identifier, *leading.equals], _OR)
    if not diagnosis.further:
        return _MISSING.given(effects=first)
    return _MISSING_TOGETHER.given(effects=listed([first, *diagnosis.further], _AND))


def serious_candidates(diagnosis: Diagnosis) -> tuple[Candidate, ...]:
    """Return the candidates that are worth a word: the first, its equals, and what is not improbable."""
    return tuple(
        each
        for each in diagnosis.candidates
        if each is diagnosis.candidates[0] or each.equals or each.probability >= _SERIOUS
    )


def listed(names: Sequence[str | Words], last: Words = _AND) -> Words:
    """Return names in a row: commas between them, and a word before the last."""
    *others, final = names
    if not others:
        return Words("{one}", "{one}").given(one=final)
    row = others[0]
    for name in others[1:]:
        row = Words("{one}, {other}", "{one}, {other}").given(one=row, other=name)
    return last.given(one=row, other=final)
