"""Effects of a catalogue: a file in which each entry is an effect that is written as a formula."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path

from zlmreport.errors import AccessError, Place
from zlmreport.job.effect_catalogue import read_catalogue, read_measurements
from zlmreport.language import Words
from zlmreport.model.effects.effect import Effect
from zlmreport.model.effects.formula import FormulaEffect


def read_effects_of_catalogue(module: str, file: str) -> tuple[Effect, ...]:
    """Return the effects of a catalogue that lies beside a module.

    The hook of a plugin that is a catalogue returns them::

        @hookimpl
        def zlmreport_effects() -> Iterable[Effect]:
            return effects_of_catalogue(__file__, "rack.yaml")

    Parameters
    ----------
    module
        The module's ``__file__``.
    file
        The name of the catalogue.

    Raises
    ------
    AccessError
        If there is no such file.
    InputError
        With every mistake in it, each at its line and column.
    """
    return read_effects_in(Path(module).parent / file)


def read_measurements_of_catalogue(module: str, file: str) -> Mapping[str, Words]:
    """Return the measurements that tell effects apart, by the names that entries of a catalogue use.

    `module` and `file` as of `read_effects_of_catalogue`, which says what is raised as well.
    """
    path = Path(module).parent / file
    return _read_measurements(path, _read_content(path))


def read_effects_in(path: Path) -> tuple[Effect, ...]:
    """Return the effects of a catalogue, as `read_effects_of_catalogue` does."""
    return _read_effects(path, _read_content(path))


def _read_content(path: Path) -> bytes:
    """Return what a file of a plugin holds: like a module, it may lie anywhere."""
    try:
        return path.read_bytes()
    except OSError as error:
        raise AccessError.at(Place(str(path)), "there is no such catalogue of effects") from error


@cache
def _read_effects(path: Path, content: bytes) -> tuple[Effect, ...]:
    """Return them from what the file holds: every entry point of its effects asks for all of them."""
    return tuple(map(FormulaEffect, read_catalogue(content, str(path), _open_beside(path))))


@cache
def _read_measurements(path: Path, content: bytes) -> Mapping[str, Words]:
    return read_measurements(content, str(path), _open_beside(path))


def _open_beside(path: Path) -> Callable[[str], bytes]:
    return lambda name: (path.parent / name).read_bytes()
