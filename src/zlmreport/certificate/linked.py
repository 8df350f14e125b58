"""The readings beside the model as values, one by one, for documents in which they can be pointed at."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from zlmreport.certificate.linked_failures import failure
from zlmreport.certificate.linked_graphs import graphs
from zlmreport.certificate.linked_texts import GRAPH_TEXTS
from zlmreport.language import Language
from zlmreport.model.diagnosis import Diagnosis
from zlmreport.model.study import Fitted, Study


@dataclass(frozen=True, slots=True)
class Linked:
    """Two graphs of the same readings, and the failures of the model that point at them; plain values only.

    Attributes
    ----------
    section
        Key of the section that they belong to.
    texts
        What they say, by name, in the document's language.
    graphs
        What both draw, in the units of the page.
    failures
        Where the model fails: statement, axis that shows it, readings.
    """

    section: str
    texts: Mapping[str, str]
    graphs: Mapping[str, Any]
    failures: tuple[Mapping[str, Any], ...]


def linked(section: str, study: Study, whole: Fitted, diagnosis: Diagnosis, language: Language) -> Linked:
    """Return the linked graphs of a studied model.

    Parameters
    ----------
    section
        Key of the section that they belong to.
    study
        The readings, none set aside.
    whole
        The model fitted to them.
    diagnosis
        What it lacks.
    language
        Of the document.
    """
    return Linked(
        section,
        {name: words.in_language(language) for name, words in GRAPH_TEXTS.items()},
        graphs(study, whole, language),
        tuple(failure(each, diagnosis, study, language) for each in diagnosis.failures),
    )
