"""The digest of readings and results: computed again from the files alone, and moved by every one of them."""

from __future__ import annotations

import base64
import csv
import json
import re
from dataclasses import replace
from hashlib import sha256
from pathlib import Path
from typing import Any

import pytest

from document.certificate.documents import certificate, having
from installed import registry
from verification.issued import READINGS, content_of, issue, lay_out
from zlmreport.document.certificate.digest import digest_of
from zlmreport.plugin.renderer import DIGEST, Certificate

_RFC_4648, _CROCKFORD = "ABCDEFGHIJKLMNOPQRSTUVWXYZ234567", "0123456789ABCDEFGHJKMNPQRSTVWXYZ"


def by_hand(results: dict[str, Any], readings: str) -> str:
    """Return the digest from a results file and its table, by other ways than the program."""
    lines = [f"certificate {results['certificate']['number']}", f"axis {results['measurements']['axis']}"]
    for row in csv.DictReader(readings.splitlines()):
        target, deviation = (f"{float(row[key]):.6f}" for key in ("target", "deviation"))
        lines += [f"reading {target} {row['direction']}1 {row['run']} {deviation}"]
    for evaluation in results["evaluations"]:
        lines.append(f"standard {evaluation['standard']}")
        for each in evaluation["parameters"]:
            numbers = (each.get(key) for key in ("value", "expanded_uncertainty", "limit"))
            written = ["-" if number is None else f"{number:.6f}" for number in numbers]
            decision = each.get("decision", {}).get("statement", "-")
            lines.append(" ".join(("result", each["symbol"], *written, each["unit"], decision)))
    first = sha256("".join(f"{line}\n" for line in lines).encode()).digest()[:10]
    letters = base64.b32encode(first).decode().translate(str.maketrans(_RFC_4648, _CROCKFORD))
    return "-".join(re.findall("....", letters))


def test_it_is_that_of_the_files_alone(tmp_path: Path) -> None:
    results = json.loads(content_of(issue(lay_out(tmp_path)), "VERIFY-1.json"))
    assert results["certificate"]["digest"] == by_hand(results, READINGS)


@pytest.mark.parametrize("layout", ["sheet", "standard", "full"])
def test_the_first_page_and_the_digital_certificate_state_it(layout: str, tmp_path: Path) -> None:
    keys = having("certificate.layout", layout, having("laboratory.country", "DE"))
    found = certificate(tmp_path, keys)
    said = repr(found.cover or found.sections[0].blocks)
    assert found.digest in said
    assert DIGEST.en in said
    digital = registry().renderer("dcc").render(found).decode()
    assert f"<dcc:value>{found.digest}</dcc:value>" in digital


def test_every_reading_and_every_result_moves_it(tmp_path: Path) -> None:
    found = certificate(tmp_path)
    evaluation = found.evaluations[0]
    first, *others = evaluation.parameters
    deviation = evaluation.measurements.deviation.copy()
    deviation[-1] += 1e-12  # the last of the decimals that are written
    read = replace(evaluation.measurements, deviation=deviation)
    known = {
        digest_of("CAL-1", changed)
        for changed in (
            [evaluation],
            [replace(evaluation, measurements=read)],
            [replace(evaluation, parameters=(replace(first, value=first.value + 1e-12), *others))],
            [replace(evaluation, parameters=(replace(first, limit=1e-3), *others))],
            [replace(evaluation, parameters=(replace(first, expanded_uncertainty=1e-3), *others))],
            [replace(evaluation, parameters=(replace(first, decision=None), *others))],
            [replace(evaluation, standard="nmtba")],
            [evaluation, evaluation],
        )
    }
    assert len(known) == 8
    assert digest_of("CAL-2", [evaluation]) not in known


def test_the_last_bit_of_a_number_does_not_move_it(tmp_path: Path) -> None:
    found: Certificate = certificate(tmp_path)
    (evaluation,) = found.evaluations
    parameters = tuple(replace(each, value=each.value * (1 + 2e-16)) for each in evaluation.parameters)
    assert digest_of("CAL-1", [replace(evaluation, parameters=parameters)]) == found.digest


def test_a_zero_has_one_sign(tmp_path: Path) -> None:
    (evaluation,) = certificate(tmp_path).evaluations
    first, *others = evaluation.parameters
    digests = {
        digest_of("CAL-1", [replace(evaluation, parameters=(replace(first, value=value), *others))])
        for value in (0.0, -0.0, -1e-14)
    }
    assert len(digests) == 1
