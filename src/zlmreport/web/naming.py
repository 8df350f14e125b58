"""How the page names effects: by identifier in English, by title in other languages."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property

from zlmreport.language import Language, named
from zlmreport.model.effects.effect import Effect

#: What may follow an identifier: the number of one that stands in a model several times, a parameter.
_AFTER = r"(?:-(?P<number>\d+))?(?:\.(?P<parameter>\w+))?(?![\w-])"


@dataclass(frozen=True)
class Naming:
    """The names of effects and their parameters in one language.

    Identifiers are English words: an English page shows them, for a job and the command line have them, too.
    """

    language: Language  #: Of the page.
    titles: Mapping[str, str]  #: By identifier.
    parameters: Mapping[tuple[str, str], str]  #: What a parameter is, by identifier and name.

    @classmethod
    def of(cls, effects: Iterable[Effect], language: Language) -> Naming:
        """Return the names of effects."""
        known = tuple(effects)
        described = {
            (each.identifier, own.name): own.description.in_language(language)
            for each in known
            for own in (*each.linear, *each.searched)
        }
        return cls(language, {each.identifier: each.title.in_language(language) for each in known}, described)

    def name_in(self, text: str) -> str:
        """Return a text, or an identifier alone, with the names of this language in place of identifiers."""
        if self.language is Language.ENGLISH or not self.titles:
            return text
        return self._pattern.sub(self._name_found, text)

    @cached_property
    def _pattern(self) -> re.Pattern[str]:
        longest_first = sorted(self.titles, key=len, reverse=True)
        return re.compile(rf"(?<![\w.-])(?P<effect>{'|'.join(map(re.escape, longest_first))}){_AFTER}")

    def _name_found(self, found: re.Match[str]) -> str:
        effect, number, parameter = found["effect"], found["number"], found["parameter"]
        name = self.titles[effect] + (f" {number}" if number else "")
        if not parameter:
            return name
        return named(name, self.parameters.get((effect, parameter), parameter)).in_language(self.language)
