"""A corpus that grows by itself: structural edits of a certificate, and what three readers show of each.

Whatever two of them show differently, or show otherwise than the certificate as it was issued, and `verify`
says to hold, is a defect. An input that is answered in a way that none before was joins the corpus, and later
inputs are edits of it.
"""

from __future__ import annotations

import random
import re
import subprocess
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from attack.structure import drawn
from installed import registry
from verification.altering import rewritten
from verification.forgeries import plain
from verification.issued import LABORATORY, issue, lay_out
from verification.remembered import remembering
from zlmreport import ZlmreportError
from zlmreport.verification import table
from zlmreport.verification.findings import VerificationOutcome, VerificationVerdict
from zlmreport.verification.readers import READERS, Reader, Seen, read_as_seen_by, remove_leads
from zlmreport.verification.verify import verify

#: Ways in which a file is damaged so that a reader has to put it together anew.
_DAMAGE: tuple[Callable[[bytes], bytes], ...] = (
    remove_leads,
    lambda content: re.sub(rb"/Size \d+", b"/Size 1", content),
    lambda content: content.replace(b"\nxref", b"\nxxxx").replace(b"startxref", b"xxxxxxxxx"),
    lambda content: content[: content.rfind(b"startxref")],
)
_SHARE_OF_CORPUS = 0.4
_LONGEST = 6


def certificate(printed: str, layout: str) -> bytes:
    """Return a certificate; `printed` is its format."""
    laboratory = LABORATORY.replace("kind: report", f"kind: report, layout: {layout}")
    with tempfile.TemporaryDirectory(prefix="zlmreport-attack-") as folder:
        return issue(lay_out(Path(folder), laboratory=laboratory), printed)


@dataclass(slots=True)
class Corpus:
    """Inputs, each as the seeds of its edits, that were answered in ways of their own."""

    kept: list[tuple[int, ...]] = field(default_factory=lambda: [()])
    answers: set[str] = field(default_factory=set)

    def draw(self, generator: random.Random) -> tuple[int, ...]:
        """Return the seeds of the next input: of a new one, or of one of the corpus with an edit more."""
        seeds = tuple(generator.randrange(2**32) for _ in range(generator.choice((1, 1, 2, 3))))
        known = generator.choice(self.kept) if generator.random() < _SHARE_OF_CORPUS else ()
        return (*known, *seeds)[-_LONGEST:]

    def learn(self, seeds: tuple[int, ...], answer: str) -> None:
        """Keep an input whose answer is new; numbers in it do not count."""
        answer = re.sub(r"\d+|'[^']*'", "#", answer)
        if answer not in self.answers:
            self.answers.add(answer)
            self.kept.append(seeds)


class Faces:
    """A certificate, and what readers show of it.

    `issued`: Its bytes.
    """

    def __init__(self, issued: bytes) -> None:
        self._bases = (plain(issued), rewritten(issued, lambda _: None))
        self._shown = {each.name: read_as_seen_by(each, issued) for each in READERS if each.is_here}

    def made(self, seeds: tuple[int, ...]) -> bytes:
        """Return the file of an input."""
        return drawn(self._bases[sum(seeds) % 8 == 0], seeds)

    def answered(self, content: bytes) -> tuple[str, bool]:
        """Return what `verify` says of a file, and whether it holds.

        What the strict reading of its bytes refuses, which is most, need not be made again for that.
        """
        refused = table.check_table(content, is_signed=False)
        if refused.verdict is VerificationVerdict.DIFFERS:
            return str(refused.detail), False
        with tempfile.TemporaryDirectory(prefix="zlmreport-attack-") as folder:
            path = Path(folder, "certificate.pdf")
            path.write_bytes(content)
            try:
                found = verify(path, registry())
            except ZlmreportError as error:
                return error.problems[0].message, False
        parts = (found.signature, *found.files, *found.pages, *found.document)
        said = [
            f"{each.subject}: {each.detail}"
            for each in parts
            if each.verdict is not VerificationVerdict.HOLDS
        ]
        return "; ".join(said[:3]) or found.outcome.value, found.outcome is VerificationOutcome.HOLDS

    def differences(self, content: bytes) -> Iterator[str]:
        """Yield what a reader shows otherwise than of the certificate as issued, also where it mends."""
        for reader in READERS:
            if not reader.is_here:
                continue
            issued = self._shown[reader.name]
            assert issued is not None
            for number, damaged in enumerate((content, *(damage(content) for damage in _DAMAGE))):
                try:
                    shown = read_as_seen_by(reader, damaged)
                except subprocess.TimeoutExpired:  # a verification leaves it open
                    continue
                is_same = shown and _is_same(shown, issued, reader, is_mended=number > 0)
                if shown is None and not number:
                    yield f"{reader.name} cannot open it"
                elif shown is not None and not is_same:
                    yield f"{reader.name} shows something else (damaged in way {number})"


def _is_same(shown: Seen, issued: Seen, reader: Reader, *, is_mended: bool) -> bool:
    """Whether what is shown is as issued; where a reader mends a file, some attachments may be lost."""
    are_pages = shown.pages == issued.pages if reader.draws else len(shown.pages) == len(issued.pages)
    files, expected = set(shown.files or ()), set(issued.files or ())
    return are_pages and (files <= expected if is_mended else files == expected)


def attacked(issued: bytes, seed: int, inputs: int) -> Iterator[tuple[tuple[int, ...], bool, list[str]]]:
    """Draw inputs; yield of each its edits, whether it holds, and what readers show otherwise if it does."""
    generator, corpus, faces = random.Random(seed), Corpus(), Faces(issued)
    with remembering():
        for _ in range(inputs):
            seeds = corpus.draw(generator)
            content = faces.made(seeds)
            answer, holds = faces.answered(content)
            corpus.learn(seeds, answer)
            yield seeds, holds, list(faces.differences(content)) if holds else []
