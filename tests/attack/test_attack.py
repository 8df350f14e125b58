"""A short part of what `./run attack` does without end, and that it finds what is planted."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable
from pathlib import Path

import pytest

from attack.adversary import Input, complaint
from attack.edits import TEXT, spoiled
from attack.faces import Corpus, Faces, attacked, certificate
from attack.targets import Target
from environments import ROOT
from processes import PYTHON, run
from verification.forgeries import plain
from verification.raw_forgeries import boxed, together


def test_a_seed_makes_the_same_file_again() -> None:
    sound = (ROOT / "configs/linear-axis/certificate.yaml").read_bytes()
    made = [spoiled(sound, (seed, seed + 1), TEXT) for seed in range(50)]
    assert made == [spoiled(sound, (seed, seed + 1), TEXT) for seed in range(50)]
    assert len(set(made)) > 40


@pytest.mark.long
@pytest.mark.early
@pytest.mark.skipif(sys.platform != "linux", reason="processes are forked")
def test_nothing_is_found_in_a_short_attack() -> None:
    done = run(PYTHON, ROOT / "tests/attack", "--inputs", "38", "--seed", "20261120")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "38 inputs, seed 20261120: 0 findings" in done.stdout


@pytest.fixture(scope="module")
def sheet() -> bytes:
    return certificate("pdf-typst", layout="sheet")


def test_no_file_that_holds_shows_two_readers_two_things(sheet: bytes) -> None:
    drawn = list(attacked(sheet, seed=20261120, inputs=25))
    assert [told for _, _, told in drawn if told] == []
    assert any(holds for _, holds, _ in drawn)


def test_what_readers_show_differently_is_told(sheet: bytes) -> None:
    """A second copy of every object, all of them altered: as if `verify` said that it held."""
    faces = Faces(sheet)
    assert list(faces.differences(plain(sheet))) == []
    told = list(faces.differences(together(plain(sheet), b"".join(boxed(sheet, 1).values()))))
    assert any(each.startswith("qpdf shows something else") for each in told) or any(
        "PDFium" in t for t in told
    )


def test_a_corpus_grows_by_what_is_answered_anew() -> None:
    corpus = Corpus()
    for seed, answer in enumerate(("object 1 is lost", "object 2 is lost", "it holds")):
        corpus.learn((seed,), answer)
    assert corpus.kept == [(), (0,), (2,)]


def _refuses_and_writes(folder: Path) -> int:
    sys.stderr.write("x\n")
    (folder / "left").touch()
    return 2


def _warns(_folder: Path) -> int:
    warnings.warn("overflow", RuntimeWarning, stacklevel=1)
    return 0


@pytest.mark.parametrize(
    ("planted", "message"),
    [
        (lambda _: 1 / 0, "raised ZeroDivisionError: division by zero"),
        (lambda _: 7, "exit code 7"),
        (lambda _: 2, "exit code 2 without a word"),
        (_refuses_and_writes, "refused, and wrote ['left']"),
        (_warns, "Warning: in the messages"),
        (lambda _: 0, ""),
    ],
)
def test_what_is_planted_is_found(planted: Callable[[Path], int], message: str) -> None:
    target = Target("planted", lambda folder: (folder / "x").touch(), "x", (planted,))
    found = complaint(Input(0, 0, (1, 2)), target)
    assert found.startswith(message)
    assert bool(found) == bool(message)


@pytest.mark.skipif(sys.platform != "linux", reason="processes are forked")
def test_what_is_found_is_shrunk_to_the_edits_that_it_needs() -> None:
    """The attack is a process of its own, and dies of one of four edits."""
    program = """if True:
        import os, sys
        sys.path[:0] = sys.argv[1:]
        from attack.adversary import Input, shrunk
        from attack.edits import spoiled
        from attack.targets import Target
        sound = b"0123456789" * 9
        edit = lambda draw, content: content + str(draw.randrange(10**9)).encode()
        fatal = spoiled(b"", (3,), (edit,))
        attack = lambda folder: os._exit(1) if fatal in (folder / "x").read_bytes() else 0
        known = [Target("x", lambda folder: (folder / "x").write_bytes(sound), "x", (attack,), (edit,))]
        least, found = shrunk(Input(0, 0, (1, 2, 3, 4)), known)
        print(least.seeds, found)
    """
    done = run(PYTHON, "-c", program, ROOT / "tests", check=True)
    assert done.stdout == "(3,) its process died, or worked 60 s, or waited 1800 s\n"
