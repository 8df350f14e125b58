"""Effects that the readings cannot tell apart, and the measurement that would."""

from __future__ import annotations

from collections.abc import Sequence

from zlmreport.language import Words
from zlmreport.model.ranking import Ranked, Ranking

_AND = Words(en="{first}; {second}", de="{first}; {second}")
_FROM = Words(en="{effect}: {measurement}", de="{effect}: {measurement}")


def equals_of(ranked: Ranked, ranking: Ranking) -> tuple[Ranked, ...]:
    """Return the other leaders, if an effect is one of them: they explain the readings as well."""
    others = tuple(each for each in ranking.leaders if each is not ranked)
    return others if len(others) < len(ranking.leaders) else ()


def discriminate_by(ranked: Ranked, equals: Sequence[Ranked]) -> Words | None:
    """Return the measurements that would tell an effect from its equals, as the effects' pages name them."""
    found: dict[str, Words] = {}
    for other in equals:
        words = _told_apart(ranked, other) or _told_apart(other, ranked)
        if words is not None:
            found.setdefault(other.identifier, words)
    if not found:
        return None
    phrases = list({words.en: words for words in found.values()}.values())
    together = phrases[0]
    for words in phrases[1:]:
        together = _AND.given(first=together, second=words)
    return together


def _told_apart(one: Ranked, other: Ranked) -> Words | None:
    for confusion in one.effect.confusions:
        if confusion.effect == other.identifier:
            return confusion.told_apart_by
    return None
