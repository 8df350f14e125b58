"""Every installed standard passes every check that a third party's author runs."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from conformance.worked import examples_of
from zlmreport.plugin.protocols import Standard
from zlmreport.plugin.registry import find_plugins
from zlmreport.testing import STANDARD_CHECKS

STANDARDS = find_plugins().standards
#: Keys with which a standard defines all that it declares.
KEYS = {
    "iso230-3": {"distance": {"X": 200, "Y": 200, "Z": 200}},
    "iso230-4:2005": {"circle": {"radius": 150, "feed": 1000, "calibrated_length": True}},
    "iso230-6:2002": {"axes": {"X": [0, 500], "Y": [0, 400], "Z": [0, 300]}},
}
#: Other values of keys that the kit finds none for.
OTHER_KEYS = {
    "iso230-3": {"distance": {"X": 100, "Y": 200, "Z": 200}},
    "iso230-1:2012": {"square": {"error": 1.5, "expanded_uncertainty": 0.5}},
    "iso230-4:2005": {"circle": {"radius": 150, "feed": 1000, "calibrated_length": False}},
    "iso230-6:2002": {"axes": {"X": [0, 400], "Y": [0, 400], "Z": [0, 300]}},
    "union-jack": {"carriage": {"expanded_uncertainty": 0.1}},
}


@pytest.mark.parametrize("standard", STANDARDS, ids=lambda standard: standard.identifier)
@pytest.mark.parametrize("check", STANDARD_CHECKS)
def test_conforms(standard: Standard, check: Callable[..., None]) -> None:
    name = standard.identifier
    options = standard.options.model_validate(KEYS.get(name, {}))
    check(standard, options, examples_of(standard), OTHER_KEYS.get(name))


def test_the_standards_that_users_are_promised_are_there() -> None:
    promised = {
        "iso230-2:1988",
        "iso230-2:1997",
        "iso230-2:2006",
        "iso230-2:2014",
        "iso230-3",
        "iso230-4:2005",
        "iso230-6:2002",
        "vdi-dgq-3441",
        "vdi-vde-2617",
        "nmtba",
    }
    assert promised <= {standard.identifier for standard in STANDARDS}
