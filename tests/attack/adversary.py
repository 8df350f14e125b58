"""What must hold whatever a command gets, and the fewest edits with which it does not."""

from __future__ import annotations

import contextlib
import difflib
import gc
import importlib
import io
import json
import os
import random
import resource
import select
import signal
import sys
import tempfile
import time
import traceback
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from attack.edits import spoiled
from attack.targets import Target
from zlmreport.plugin.registry import candidate, find

#: Exit codes of a command that refuses.
_REFUSED = (2, 3)
#: Processor seconds of an input, and of one after which its process is ended; seconds of a wait for nothing.
_SECONDS, _ENDLESS, _PATIENCE = 30, 60, 1_800
#: That the memory of a process may grow by an input, MB.
_MEGABYTES = 600


@dataclass(frozen=True, slots=True)
class Input:
    """A spoiled file: the target, which of its attacks, and the seed of each edit."""

    target: int
    attack: int
    seeds: tuple[int, ...]


def inputs(seed: int, known: Sequence[Target]) -> Iterator[Input]:
    """Yield inputs without end: rounds in which each target has its share, and first each once."""
    draw = random.Random(seed)
    while True:
        for turn in range(max(target.share for target in known)):
            for number, target in enumerate(known):
                if turn < target.share:
                    seeds = tuple(draw.randrange(2**32) for _ in range(draw.choice((1, 1, 1, 2, 2, 3, 6))))
                    yield Input(number, draw.randrange(len(target.attacks)), seeds)


def warm_up(known: Sequence[Target]) -> None:
    """Import what the attacks import, and load installed plugins once: processes of inputs are forks of this.

    The attacks are made on sound files in a child, for some start threads, which do not outlive a fork.
    """
    find.entry_points = cache(find.entry_points)  # type: ignore[assignment,attr-defined]
    candidate._checked = cache(candidate._checked)
    reading, writing = os.pipe()
    if not (child := os.fork()):
        for number, target in enumerate(known):
            for attack in range(len(target.attacks)):
                complaint(Input(number, attack, ()), target)
        with os.fdopen(writing, "w") as pipe:
            json.dump(list(sys.modules), pipe)
        os._exit(0)
    os.close(writing)
    with os.fdopen(reading) as pipe:
        names = json.load(pipe)
    os.waitpid(child, 0)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for name in names:
            with contextlib.suppress(ImportError):  # of a folder that is gone
                importlib.import_module(name)
        find.find_plugins({}).list_offers()
    gc.collect()
    gc.freeze()


def _files(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def _grown() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def complaint(each: Input, target: Target) -> str:
    """Make an attack and return what does not hold; empty if all does."""
    with tempfile.TemporaryDirectory(prefix="zlmreport-attack-") as name:
        folder = Path(name)
        target.lay_out(folder)
        file = folder / target.spoilt
        file.write_bytes(spoiled(file.read_bytes(), each.seeds, target.edits))
        before, memory, begun = _files(folder), _grown(), time.process_time()
        out, err = io.TextIOWrapper(io.BytesIO(), "utf-8"), io.StringIO()
        try:
            with (
                contextlib.redirect_stdout(out),
                contextlib.redirect_stderr(err),
                warnings.catch_warnings(record=True) as warned,
            ):
                warnings.simplefilter("always")
                code = target.attacks[each.attack](folder)
        except BaseException as error:  # noqa: BLE001 - whatever comes out of a command is a mistake
            place = traceback.extract_tb(error.__traceback__)[-1]
            return f"raised {type(error).__name__}: {error} ({Path(place.filename).name}:{place.lineno})"
        spent, grown = time.process_time() - begun, _grown() - memory
        after = _files(folder)
    shown_warnings = "".join(
        f"{each.category.__name__}: {each.message} ({each.filename}:{each.lineno})" for each in warned
    )
    wrote = after.keys() ^ before.keys() or {name for name in after if after[name] != before[name]}
    return next(_broken(code, f"{err.getvalue()}{shown_warnings}", wrote), "") or next(
        _bounds(spent, grown), ""
    )


def _broken(code: int, said: str, wrote: set[str]) -> Iterator[str]:
    """Yield what does not hold of an exit code, messages, and what was written."""
    if code not in range(6):
        yield f"exit code {code}"
    for mark in ("Traceback (most recent", "Warning: "):
        if mark in said:
            yield f"{mark.strip()} in the messages: {said[max(said.index(mark) - 80, 0) :][:300]}"
    if code in _REFUSED and not said:
        yield f"exit code {code} without a word"
    if code in _REFUSED and wrote:
        yield f"refused, and wrote {sorted(wrote)}"


def _bounds(spent: float, grown: float) -> Iterator[str]:
    if spent > _SECONDS:
        yield f"took {spent:.0f} s"
    if grown > _MEGABYTES:
        yield f"took {grown:.0f} MB"


def answers(batch: Sequence[Input], known: Sequence[Target]) -> Iterator[tuple[Input, str]]:
    """Make attacks in a process of their own, and yield what each came to; one that it dies of, too."""
    left = list(batch)
    while left:
        reading, writing = os.pipe()
        child = os.fork()
        if not child:
            try:
                os.close(reading)
                with os.fdopen(writing, "w") as pipe:
                    for each in left:
                        ends = int(time.process_time()) + _ENDLESS
                        resource.setrlimit(resource.RLIMIT_CPU, (ends, resource.RLIM_INFINITY))
                        print(json.dumps(complaint(each, known[each.target])), file=pipe, flush=True)
            except BaseException:  # noqa: BLE001 - a mistake of this program, in a child of it
                traceback.print_exc()
            os._exit(0)
        os.close(writing)
        with os.fdopen(reading) as pipe:
            while left:
                line = pipe.readline() if select.select([pipe], [], [], _PATIENCE)[0] else ""
                if not line:
                    break
                yield left.pop(0), json.loads(line)
        with contextlib.suppress(ProcessLookupError):
            os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        if left:
            yield left.pop(0), f"its process died, or worked {_ENDLESS} s, or waited {_PATIENCE} s"


def shrunk(each: Input, known: Sequence[Target]) -> tuple[Input, str]:
    """Return the input with the fewest edits that still breaks something, and what."""
    ((_, found),) = answers([each], known)
    for number in reversed(range(len(each.seeds))):
        fewer = Input(each.target, each.attack, each.seeds[:number] + each.seeds[number + 1 :])
        ((_, still),) = answers([fewer], known)
        if still:
            each, found = fewer, still
    return each, found


def shown(each: Input, known: Sequence[Target]) -> str:
    """Return what the edits did to the file."""
    target = known[each.target]
    with tempfile.TemporaryDirectory() as name:
        target.lay_out(Path(name))
        sound = (Path(name) / target.spoilt).read_bytes()
    texts = [
        content.decode("latin-1").splitlines()
        for content in (sound, spoiled(sound, each.seeds, target.edits))
    ]
    return "\n".join(ascii(line)[1:200] for line in difflib.unified_diff(*texts, n=0, lineterm=""))
