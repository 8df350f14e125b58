"""The hooks and the protocols, as the code declares them."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterator

from markdown import code, table

from zlmreport.live.emulation.emulator import Emulator
from zlmreport.live.ports.reading import LiveReading
from zlmreport.model.planning.programs import Motion, PlannedReading, ProgramStop
from zlmreport.plugin.extending import Command, CommandHost, CommandOption, ExtensionPlan, Happening, LiveRun
from zlmreport.plugin.kinds import KINDS
from zlmreport.plugin.protocols import Connection, SourceContext
from zlmreport_step_gauge.paths.path import Probing, ProbingPath, Travel

_PROTOCOLS = (
    *(kind.protocol for kind in KINDS),
    SourceContext,
    Motion,
    ProgramStop,
    PlannedReading,
    Connection,
    LiveReading,
    Emulator,
    ExtensionPlan,
    LiveRun,
    Happening,
    Command,
    CommandOption,
    CommandHost,
    ProbingPath,
    Travel,
    Probing,
)


def hooks_text() -> str:
    """Return the hooks with their signatures."""
    rows = [
        (code(f"{kind.hook}() -> Iterable[{kind.interface}]"), f"Return {kind.offers}.") for kind in KINDS
    ]
    return table(("Hook", "What it does"), rows)


def protocols_text() -> str:
    """Return the members of each protocol, with what the code says of them."""
    return "\n\n".join(part for protocol in _PROTOCOLS for part in _protocol(protocol))


def _protocol(protocol: type) -> Iterator[str]:
    yield f"### {protocol.__name__}"
    yield _first_line(protocol)
    described = _attributes(inspect.getdoc(protocol) or "")
    rows = [(code(f"{name}: {type_}"), described[name]) for name, type_ in _annotations(protocol)]
    for name, function in vars(protocol).items():
        if inspect.isfunction(function) and not name.startswith("_"):
            rows.append((code(_signature(name, function)), " ".join(_without_sections(function).split())))
    yield table(("Member", "Meaning"), rows)


def _annotations(protocol: type) -> list[tuple[str, str]]:
    return [(name, str(type_)) for name, type_ in protocol.__annotations__.items()]


def _attributes(doc: str) -> dict[str, str]:
    """Return what a numpydoc docstring says of each attribute."""
    found: dict[str, str] = {}
    names: list[str] = []
    _, _, section = doc.partition("Attributes\n----------\n")
    for line in section.splitlines():
        if line.startswith("    "):
            for name in names:
                found[name] = f"{found.get(name, '')} {line.strip()}".strip()
        elif line.strip():
            names = [name.strip() for name in line.split(":")[0].split(",")]
    return {name: _in_markdown(description) for name, description in found.items()}


def _doc(documented: object) -> str:
    return _in_markdown(inspect.getdoc(documented) or "")


def _without_sections(documented: object) -> str:
    return re.split(r"\n\n(?:Parameters|Raises|Notes)\n-+\n", _doc(documented))[0]


def _first_line(documented: object) -> str:
    return _doc(documented).partition("\n")[0]


def _in_markdown(text: str) -> str:
    return text.replace("``", "`")


def _signature(name: str, function: Callable[..., object]) -> str:
    """Return how a function is declared, without the quotation marks of postponed annotations."""
    return f"{name}{inspect.signature(function)}".replace("'", "")
