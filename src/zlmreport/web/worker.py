"""Diagnoses in a process of their own: ``python -m zlmreport.web.worker JOB.yaml``.

A diagnosis keeps a processor busy for a second, or for minutes on thousands of readings. Apart, it slows no
page down, and is ended when nobody waits for it any more. A line of standard input asks for a diagnosis of
the job as it is on the disk; a line of JSON answers.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

from zlmreport.errors import ZlmreportError
from zlmreport.language import Language
from zlmreport.plugins import Registry, find_plugins
from zlmreport.web.bench import Bench
from zlmreport.web.diagnosed import diagnosed


def main() -> None:
    """Answer until nobody asks."""
    path, *plugins = map(Path, sys.argv[1:])
    registry = find_plugins(files=plugins)
    bench = Bench(path, registry)
    for _ in sys.stdin:
        print(json.dumps(answer(bench, registry)), flush=True)  # noqa: T201 - the answer


def answer(bench: Bench, registry: Registry) -> dict[str, Any]:
    """Return the diagnosis of the job in all languages, and of which state of the job it is."""
    try:
        loaded = bench.loaded()
        diagnosis = loaded.study.diagnosis(registry.effects)
    except ZlmreportError as error:
        return {"stamp": bench.stamp(), "problems": [str(each) for each in error.problems]}
    return {
        "stamp": loaded.stamp,
        "diagnosis": {
            language.value: diagnosed(diagnosis, loaded.study, registry.effects, language)
            for language in Language
        },
    }


if __name__ == "__main__":
    main()
