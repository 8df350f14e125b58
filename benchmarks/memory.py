"""Resident memory of one process after many certificates."""

from __future__ import annotations

from collections.abc import Callable
from itertools import count
from pathlib import Path
from tempfile import TemporaryDirectory

from content import content
from measure import Measured, Sizes, own_process, resident_megabytes
from sample import write_job
from zlmreport.job.loading import load
from zlmreport.pipeline import compose, run
from zlmreport.plugin.registry import find_plugins

#: By then caches are full and libraries warm.
_SETTLED = 50
_CERTIFICATES = 300
_TARGET = 5.0


def measure(sizes: Sizes) -> list[Measured]:
    """Measure both recipes at the same time, each in a process of its own."""
    settled = min(_SETTLED, sizes.certificates // 2)
    with own_process() as one, own_process() as other:
        growths = {
            "zlmreport": one.submit(_zlmreport, settled, sizes.certificates),
            "plain recipe": other.submit(_plain_recipe, settled, sizes.certificates),
        }
        megabytes = {name: growth.result() for name, growth in growths.items()}
    lines = []
    for name, (begin, end) in megabytes.items():
        target = _TARGET if name == "zlmreport" and sizes.certificates == _CERTIFICATES else None
        lines += [
            Measured(f"{name} after {settled} certificates", begin, "MB"),
            Measured(f"{name} after {sizes.certificates} certificates", end, "MB"),
            Measured(f"{name}, growth", end - begin, "MB", target),
        ]
    return lines


def _zlmreport(settled: int, certificates: int) -> tuple[float, float]:
    """Watch jobs become PDFs, each with readings of its own."""
    registry = find_plugins()
    with TemporaryDirectory() as folder:
        numbers = count()

        def make() -> None:
            job = write_job(Path(folder), f"MEMORY-{next(numbers):04}")
            run(load(job, registry), registry)

        return _watched(make, settled, certificates)


def _plain_recipe(settled: int, certificates: int) -> tuple[float, float]:
    """Watch the plain recipe make one document again and again."""
    import plain  # noqa: PLC0415 - it changes matplotlib's configuration

    with TemporaryDirectory() as folder:
        registry = find_plugins()
        words = content(compose(load(write_job(Path(folder), "MEMORY-0000"), registry), registry))
    return _watched(lambda: plain.certificate(words), settled, certificates)


def _watched(make: Callable[[], object], settled: int, certificates: int) -> tuple[float, float]:
    """Return the memory in use after the first and after all certificates."""
    for _ in range(settled):
        make()
    begin = resident_megabytes()
    for _ in range(certificates - settled):
        make()
    return begin, resident_megabytes()
