"""Whatever stands in a job file, it is loaded or refused in words: nothing else may happen."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

import pytest
import yaml
from hypothesis import example, given, settings, strategies as st

from job.jobs import REGISTRY, SOUND
from zlmreport import ZlmreportError
from zlmreport.job import parse
from zlmreport.job.loading import load

unhurried = settings(deadline=None)
_LINES = SOUND.splitlines()
_VALUES = st.one_of(
    st.text(max_size=30),
    st.sampled_from(
        ["{}", "[]", "~", "*a", "&a b", "!!int x", "|", ">-", "'", '"', "{", "[", "- a", "? b", "%c"]
    ),
    st.floats().map(str),
    st.integers().map(str),
)
_KEYS = st.sampled_from(
    sorted({line.split(":")[0].strip(" -") for line in _LINES} | {"extends", "instrument"})
)


def _load(content: bytes) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "job.yaml")
        path.write_bytes(content)
        messages = []
        try:
            load(path, REGISTRY)
        except ZlmreportError as error:
            messages = [problem.message for problem in error.problems]
            refused = True
        else:
            refused = False
    assert refused == bool(messages)
    assert all(message.isprintable() for message in messages)


@unhurried
@given(st.binary(max_size=200))
def test_any_bytes(content: bytes) -> None:
    _load(content)


@unhurried
@given(st.text(max_size=200))
def test_any_text(text: str) -> None:
    _load(text.encode("utf-8", "surrogatepass"))


@unhurried
@given(st.text(alphabet="ab:{}[]-'\"#&*!|>%@` \n\t,?0.", max_size=60))
def test_any_text_of_characters_that_mean_something_in_yaml(text: str) -> None:
    _load(text.encode())


@settings(max_examples=100, deadline=None)
@given(st.integers(0, len(_LINES) - 1), st.integers(0, 8), _KEYS, _VALUES)
def test_any_value_for_any_key(number: int, indentation: int, key: str, value: str) -> None:
    lines = [*_LINES]
    lines[number] = f"{' ' * indentation}{key}: {value}"
    _load("\n".join(lines).encode("utf-8", "surrogatepass"))


@unhurried
@example(start=293, inserted="\ud7fc", removed=2)  # a letter that does not exist, in a symbol
@given(st.integers(0, len(SOUND)), st.text(max_size=5), st.integers(0, 20))
def test_any_damage_to_a_sound_job(start: int, inserted: str, removed: int) -> None:
    _load((SOUND[:start] + inserted + SOUND[start + removed :]).encode("utf-8", "surrogatepass"))


def _parsed(content: str, parser: Any) -> object:
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(parse, "_QUICK", parser)
        try:
            return parse.parse(content.encode("utf-8", "surrogatepass"), "job.yaml")
        except ZlmreportError as error:
            return error.problems


@unhurried
@given(
    st.integers(0, len(SOUND)),
    st.text(alphabet="ab:{}[]-'\"#&*!|>%@` \n\t,?\\\u2028", max_size=4),
    st.integers(0, 9),
)
def test_a_job_reads_the_same_with_and_without_libyaml(start: int, inserted: str, removed: int) -> None:
    damaged = SOUND[:start] + inserted + SOUND[start + removed :]
    assert _parsed(damaged, yaml.SafeLoader) == _parsed(damaged, parse._QUICK)
