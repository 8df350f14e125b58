"""The version rises with every change of results or pages: `releases.yaml` says what each release gave.

A certificate of another release is told from a forged one by its release alone, so two programs that print
otherwise must not have the same. What a release gives is a fingerprint of the project's own examples: digests
of the approved texts of certificates in each language, of the results of a report, of the words of its pages
by each renderer, and of the templates. Numbers are rounded, and places on pages left out: other libraries
compute the last digits otherwise, and shift a line.

The present fingerprint is compared with that of the last release, so that the version rises once between two
releases, however often results change.
"""

from __future__ import annotations

import datetime as dt
import json
import re
from collections.abc import Mapping
from hashlib import sha256
from io import BytesIO
from pathlib import Path
from typing import Any

import yaml
from pypdf import PdfReader

from environments import ROOT
from verification.issued import NUMBER, content_of
from zlmreport import __version__

RELEASES = ROOT / "releases.yaml"
_RELEASED = re.compile(r"RELEASED = dt\.date\(.*\)")
_VERSION = ROOT / "src" / "zlmreport" / "version.py"
_CHANGES = ROOT / "CHANGELOG.md"
_GOLDEN = ROOT / "tests" / "document" / "certificate" / "golden"
_TEMPLATES = ROOT / "report_templates" / "zlmreport_templates"
_OF_PAGES = ("A4.css", "Letter.css", "certificate.css", "paged.css", "tokens.css")
_HEADING = "## Unreleased ({})"
_HEAD = """\
# What each release computes and prints of the project's own examples; see tests/release/rule.py.
# `./run release record` adds the present one, `./run release raise` begins the next.
"""


def fingerprint(reports: Mapping[str, bytes]) -> dict[str, str]:
    """Return what this program gives, as digests by what they are of.

    `reports` is the report of `verification.issued` as each renderer makes it.
    """
    found = {
        f"texts {language}": _digest(
            *(each.read_text(encoding="utf-8") for each in sorted(_GOLDEN.glob(f"*.{language}.txt")))
        )
        for language in ("de", "en")
    }
    styles = [_TEMPLATES / "styles" / name for name in _OF_PAGES]
    found["styles"] = _digest(*(each.read_text(encoding="utf-8") for each in styles))
    for renderer, pdf in reports.items():
        results = json.loads(content_of(pdf, f"{NUMBER}.json"), parse_float=_rounded)
        del results["provenance"]
        found["results"] = _digest(json.dumps(results, sort_keys=True))
        pages = [" ".join(page.extract_text().split()) for page in PdfReader(BytesIO(pdf)).pages]
        found[f"pages {renderer}"] = _digest(*(_without_release(page) for page in pages))
    return found


def broken(version: str, present: Mapping[str, str], releases: Mapping[str, Mapping[str, str]]) -> str:
    """Return what breaks the rule, and what to do; empty if it is kept."""
    last = max(releases, key=_order)
    if _order(version) > _order(last):
        return ""
    changed = [key for key, digest in releases[last].items() if present.get(key, digest) != digest]
    if not changed and version == last:
        return ""
    what = f"{', '.join(changed)} changed since it was released" if changed else "it is lower"
    return f"version {version}, and release {last}: {what}. Raise the version: ./run release raise"


def released() -> dict[str, dict[str, str]]:
    """Return the fingerprint of each release, by its version."""
    read: dict[str, dict[str, str]] = yaml.safe_load(RELEASES.read_text(encoding="utf-8"))
    return read


def record(present: Mapping[str, str], today: dt.date) -> str:
    """Write down that the present version is released, and on which day, and return what was done."""
    rows = {**released(), __version__: dict(present)}
    RELEASES.write_text(_HEAD + yaml.safe_dump(rows, sort_keys=False), encoding="utf-8")
    _replace(_CHANGES, _HEADING.format(__version__), f"## {__version__}")
    stated = _VERSION.read_text(encoding="utf-8")
    day = f"RELEASED = dt.date({today.year}, {today.month}, {today.day})"
    _VERSION.write_text(_RELEASED.sub(day, stated), encoding="utf-8")
    return f"{__version__} is recorded in {RELEASES.name} and {_CHANGES.name}; tag it v{__version__}\n"


def raise_version() -> str:
    """Begin the next release, and return what was done; one that is not released is not passed over."""
    if __version__ not in released():
        return f"{__version__} is not released yet: its results and pages may change\n"
    major, minor, *_ = _order(__version__)
    following = f"{major}.{minor + 1}.0"
    _replace(_VERSION, __version__, following)
    _replace(_CHANGES, f"## {__version__}", f"{_HEADING.format(following)}\n\n## {__version__}")
    return f"{following} stands in {_VERSION.name} and {_CHANGES.name}\n"


def _replace(file: Path, old: str, new: str) -> None:
    file.write_text(file.read_text(encoding="utf-8").replace(old, new, 1), encoding="utf-8")


def _order(version: str) -> tuple[int, ...]:
    return tuple(map(int, version.split(".")))


def _rounded(number: str) -> str:
    return f"{round(float(number), 9):.7g}"


def _without_release(text: str) -> str:
    return re.sub(r"\d+\.\d+\.\d+", "", text)


def _digest(*texts: Any) -> str:
    return sha256("\0".join(texts).encode()).hexdigest()[:16]
