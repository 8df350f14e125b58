"""The examples in the docstrings of the program and of its plugins give what they say."""

from __future__ import annotations

import doctest
from importlib import import_module
from pathlib import Path

import pytest

from environments import ROOT

_SHOWN = [
    path.relative_to(root).with_suffix("")
    for root in (ROOT / "src", ROOT / "plugins")
    for path in sorted(root.glob("zlmreport*/**/*.py"))
    if ">>> " in path.read_text(encoding="utf-8") and path.stem != "conftest"
]


@pytest.mark.parametrize("path", _SHOWN, ids=str)
def test_the_examples_of_a_module_give_what_they_say(path: Path) -> None:
    parts = path.parts[:-1] if path.name == "__init__" else path.parts
    module = import_module(".".join(parts))
    outcome = doctest.testmod(module, optionflags=doctest.NORMALIZE_WHITESPACE)
    assert outcome.attempted
    assert not outcome.failed
