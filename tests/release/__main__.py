"""``./run release record``: the present version is released; ``./run release raise``: the next one begins."""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))  # for its neighbours, as pytest has them

from release.rule import fingerprint, raise_version, record
from verification.issued import issue, lay_out
from zlmreport.job.days import read_clock

if __name__ == "__main__":
    match sys.argv[1:]:
        case ["raise"]:
            sys.stdout.write(raise_version())
        case ["record"]:
            with tempfile.TemporaryDirectory() as folder:
                job = lay_out(Path(folder))
                sys.stdout.write(
                    record(
                        fingerprint({name: issue(job, name) for name in ("pdf", "pdf-typst")}), read_clock()
                    )
                )
        case _:
            sys.exit(__doc__)
