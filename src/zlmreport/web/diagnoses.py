"""Keeps one diagnosis under way, in a process of its own, and in the user's cache those that were made.

A diagnosis keeps a processor busy for a second, or for minutes on thousands of readings. Apart, it slows no
page down, and is ended when the job has changed or nobody waits for it. A line of standard input of that
process, ``python -m zlmreport.web.diagnoses JOB.yaml``, asks for a diagnosis of the job as it stands; a
line of JSON answers. What was answered once is remembered by the content of the files: taking a step back
asks nothing anew.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from threading import Lock, Thread
from typing import Any

from zlmreport import version
from zlmreport.errors import AccessError, ZlmreportError
from zlmreport.files import Document, find_cache_folder, write
from zlmreport.job.job import Job
from zlmreport.language import Language
from zlmreport.model.diagnosis.contest import Told, tell_nobody
from zlmreport.model.effects.circle_effect import CircleEffect
from zlmreport.model.effects.effect import Effect
from zlmreport.model.planning.deciding import collect_experiment, plan_experiment_of_tie
from zlmreport.model.planning.experiment import Experiment
from zlmreport.plugin.registry import Registry, find_plugins
from zlmreport.web.bench import Bench
from zlmreport.web.naming import Naming
from zlmreport.web.processes import start_module
from zlmreport.web.view import collect_diagnosed

#: Diagnoses that are kept: some hundred kilobytes each.
_KEPT = 200


@dataclass(frozen=True, slots=True)
class DiagnosesByContent:
    """Diagnoses by the content of the files that they were made from."""

    folder: Path | None  #: Where they lie; None for memory alone.
    program: str  #: Names the program and the effects that make them.
    _known: dict[str, Any] = field(default_factory=dict)

    @classmethod
    def of_user(cls, effects: Iterable[Effect | CircleEffect]) -> DiagnosesByContent:
        """Return those of a user, of this program with these effects."""
        folder = find_cache_folder()
        return cls(folder / "diagnoses" if folder else None, _identify_program(effects))

    def recall(self, content: str) -> Any:
        """Return the diagnosis of a content; None if none was made."""
        name = self._name_file(content)
        if name not in self._known and self.folder:
            with contextlib.suppress(OSError, ValueError):
                self._known[name] = json.loads((self.folder / name).read_text(encoding="utf-8"))
        return self._known.get(name)

    def keep(self, content: str, diagnosis: Any) -> None:
        """Remember the diagnosis of a content; the oldest give way."""
        name = self._name_file(content)
        self._known[name] = diagnosis
        if self.folder is None:
            return
        with contextlib.suppress(AccessError, OSError):
            write([Document(self.folder / name, json.dumps(diagnosis).encode())])
            kept = sorted(self.folder.glob("*.json"), key=lambda each: each.stat().st_mtime_ns)
            for path in kept[:-_KEPT]:
                path.unlink()

    def _name_file(self, content: str) -> str:
        return f"{hashlib.sha256(f'{self.program} {content}'.encode()).hexdigest()}.json"


def _identify_program(effects: Iterable[Effect | CircleEffect]) -> str:
    """Return what tells this program and its effects, as they stand in their files, from any other."""
    package = Path(version.__file__).parent
    modules = (sys.modules.get(each.__class__.__module__) for each in effects)
    homes = {Path(found) for each in modules if (found := getattr(each, "__file__", None))}
    stats = [(str(path), path.stat()) for path in sorted({*package.rglob("*.py"), *homes})]
    return repr([(path, stat.st_mtime_ns, stat.st_size) for path, stat in stats])


_ENDED = "the diagnosis ended unexpectedly"
_SHARE = "share-done"
_TOLD = f'{{"{_SHARE}"'
_MODULE = "zlmreport.web.diagnoses"


@dataclass(slots=True)
class Diagnoses:
    """The diagnosis of a job, made beside the pages."""

    path: Path  #: The job file.
    answers: DiagnosesByContent  #: Diagnoses that were made before.
    plugins: Sequence[Path] = ()  #: Files that are plugins, from the command line.
    module: str = _MODULE  #: What answers, run as a program.
    _worker: subprocess.Popen[str] | None = None
    _asked: str = ""
    _began: float = 0.0
    _share: float = 0.0
    _answer: dict[str, Any] | None = None
    _lock: Lock = field(default_factory=Lock)

    def find(self, content: str) -> dict[str, Any]:
        """Return the diagnosis of a job of this content, or for how long it has run, and the share done."""
        with self._lock:
            known = self.answers.recall(content)
            if known is not None:
                return {"diagnosis": known}
            if self._asked != content:
                self._ask(content)
            if self._answer is not None and self._answer.get("content", content) != content:
                self._ask(content)  # the job changed while its files were read
            if self._answer is None:
                return {"seconds": round(time.monotonic() - self._began, 1), "share": self._share}
            self._asked = ""  # what failed may do better when it is asked for again
            return self._answer

    def stop(self) -> None:
        """Let go of the diagnosis that is under way; who asks is told so once, and then begins it anew."""
        with self._lock:
            if self._asked and self._answer is None:
                self._end()
                self._answer = {"stopped": True}

    def end(self) -> None:
        """End the process."""
        with self._lock:
            self._end()

    def start_early(self) -> None:
        """Start the process, so that the first diagnosis need not wait for it."""
        with self._lock:
            self._start_process()

    def _ask(self, content: str) -> None:
        if self._asked and self._answer is None:
            self._end()
        worker = self._start_process()
        self._asked, self._answer, self._began, self._share = content, None, time.monotonic(), 0.0
        assert worker.stdin is not None  # noqa: S101 - opened as a pipe
        try:
            worker.stdin.write("\n")
            worker.stdin.flush()
        except BrokenPipeError:
            self._end()
            self._answer = {"problems": [_ENDED]}
            return
        Thread(target=self._listen, args=(worker, content), daemon=True).start()

    def _listen(self, worker: subprocess.Popen[str], content: str) -> None:
        assert worker.stdout is not None  # noqa: S101 - opened as a pipe
        while _TOLD in (line := worker.stdout.readline()):
            with self._lock:
                if worker is not self._worker or content != self._asked:
                    return
                self._share = json.loads(line)[_SHARE]
        with self._lock:
            if worker is not self._worker or content != self._asked:
                return
            if line:
                self._answer = json.loads(line)
                if "diagnosis" in self._answer:
                    self.answers.keep(self._answer["content"], self._answer["diagnosis"])
            else:
                self._end()
                self._answer = {"problems": [_ENDED]}

    def _start_process(self) -> subprocess.Popen[str]:
        if self._worker is None:
            self._worker = start_module(
                self.module,
                *(str(each.resolve()) for each in (self.path, *self.plugins)),
                stdin=subprocess.PIPE,
                environment={"OPENBLAS_NUM_THREADS": "1"},
            )
        return self._worker

    def _end(self) -> None:
        worker, self._worker = self._worker, None
        if worker is None:
            return
        worker.kill()
        worker.wait()
        for pipe in (worker.stdin, worker.stdout):
            if pipe is not None:
                pipe.close()


def main() -> None:
    """Answer until nobody asks."""
    path, *plugins = map(Path, sys.argv[1:])
    registry = find_plugins(files=plugins)
    bench = Bench(path, registry)
    answer_all(lambda told: answer(bench, registry, told))


def answer_all(answered: Callable[[Told], dict[str, Any]]) -> None:
    """Answer each line of standard input by one of JSON; before it, how much is done."""
    for _ in sys.stdin:
        print(json.dumps(answered(_tell)), flush=True)  # noqa: T201 - the answer


def _tell(share: float) -> None:
    print(json.dumps({_SHARE: round(share, 3)}), flush=True)  # noqa: T201 - read as the answer is


def answer(bench: Bench, registry: Registry, told: Told = tell_nobody) -> dict[str, Any]:
    """Return the diagnosis of the job in all languages, what decides its tie, and of which content it is."""
    try:
        loaded = bench.load()
        study = loaded.study
        diagnosis = study.diagnose(registry.effects, told)
        experiment = plan_experiment_of_tie(study, diagnosis, registry.effects)
    except ZlmreportError as error:
        return {"problems": [str(each) for each in error.problems]}
    return {
        "content": loaded.content,
        "diagnosis": {
            language.value: {
                **collect_diagnosed(diagnosis, study, registry.effects, language),
                "experiment": experiment
                and _make_experiment(experiment, loaded.job, registry.effects, language),
            }
            for language in Language
        },
    }


def _make_experiment(
    experiment: Experiment, job: Job, effects: Sequence[Effect], language: Language
) -> dict[str, Any]:
    values = collect_experiment(experiment, job, language)
    return {**values, "statement": Naming.of(effects, language).name_in(values["statement"])}


if __name__ == "__main__":
    main()
