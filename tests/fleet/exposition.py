"""Reads Prometheus's text format as strictly as its documentation describes it (version 0.0.4).

prometheus.io/docs/instrumenting/exposition_formats, section "Text format details"; and what the collector of
text files in node_exporter refuses: samples with times.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

_NAME = r"[a-zA-Z_:][a-zA-Z0-9_:]*"
_LABEL = re.compile(r'([a-zA-Z_][a-zA-Z0-9_]*)="((?:[^"\\\n]|\\["\\n])*)"(,|$)')
_HELP = re.compile(rf"# HELP ({_NAME}) ((?:[^\\]|\\[\\n])*)")
_TYPE = re.compile(rf"# TYPE ({_NAME}) (counter|gauge|histogram|summary|untyped)")
_SAMPLE = re.compile(rf"({_NAME})(?:\{{(.*)\}})? (\S+)")


@dataclass(slots=True)
class Family:
    """A metric as it is read: its help, its type, and its samples by their labels."""

    about: str
    kind: str
    samples: dict[frozenset[tuple[str, str]], float] = field(default_factory=dict)


def parse(text: str) -> dict[str, Family]:
    """Return the families of a text; whatever the format does not allow fails."""
    assert text == "" or text.endswith("\n")
    found: dict[str, Family] = {}
    lines = iter(text.split("\n")[:-1])
    current = ""
    for line in lines:
        about = _HELP.fullmatch(line)
        if about:
            current = about[1]
            assert current not in found, f"{current} stands twice"
            kind = _TYPE.fullmatch(next(lines))
            assert kind
            assert kind[1] == current
            found[current] = Family(_unescaped(about[2]), kind[2])
            continue
        sample = _SAMPLE.fullmatch(line)
        assert sample, line
        assert sample[1] == current, f"{line}: not together with its family"
        labels = frozenset(_labels(sample[2] or ""))
        assert labels not in found[current].samples, f"{line}: stands twice"
        found[current].samples[labels] = float(sample[3])
    return found


def _labels(text: str) -> list[tuple[str, str]]:
    found = []
    place = 0
    while place < len(text):
        match = _LABEL.match(text, place)
        assert match, text[place:]
        found.append((match[1], _unescaped(match[2])))
        place = match.end()
    assert len({name for name, _ in found}) == len(found)
    return found


def _unescaped(text: str) -> str:
    return re.sub(r"\\(.)", lambda match: "\n" if match[1] == "n" else match[1], text)
