"""What pages call the parameters of effects of circles, in every language."""

import re

import pytest

from installed import registry
from zlmreport.model.effects.circle_effect import title_parameter
from zlmreport.plugin import Language
from zlmreport.plugin.circle_effect import CircleEffect
from zlmreport.testing import circle_designs

#: Words that are no language's: functions, and the names of the tests of which a design consists.
_NO_LANGUAGE = re.compile(r"\b(sin|cos|circle-\d)\b")
EFFECTS = registry().circle_effects


def titles(effect: CircleEffect, language: Language) -> list[str]:
    """Return what all its parameters are called, on all designs and with the first values of θ."""
    designs = circle_designs().values()
    terms = [
        term for each in designs for first in effect.grid(each)[:1] for term in effect.terms(each, first)
    ]
    return [title_parameter(each).in_language(language) for each in (*terms, *effect.searched)]


@pytest.mark.parametrize("effect", EFFECTS, ids=[each.identifier for each in EFFECTS])
@pytest.mark.parametrize("language", [each for each in Language if each is not Language.ENGLISH])
def test_a_page_calls_no_parameter_by_an_english_word(effect: CircleEffect, language: Language) -> None:
    """A word of the English title stands in no other language's title."""
    pairs = zip(titles(effect, Language.ENGLISH), titles(effect, language), strict=True)
    for english, other in pairs:
        words = re.findall(r"\b[a-z]{2,}\b", _NO_LANGUAGE.sub("", english))
        kept = [word for word in words if re.search(rf"\b{word}\b", other)]
        assert not kept, f"{effect.identifier}: {other}"


@pytest.mark.parametrize("effect", EFFECTS, ids=[each.identifier for each in EFFECTS])
def test_no_title_has_an_underscore(effect: CircleEffect) -> None:
    """A name of a results file such as T_X-T_Y is no text of a page."""
    assert not [each for each in titles(effect, Language.ENGLISH) if "_" in each]
