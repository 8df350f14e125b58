"""What somebody who follows a run comes past: ``./run benchmark hops``.

A command is run in a process of its own. Counted are the own functions that it enters at least once, and the
own files in which these stand; own is what stands in ``src`` and ``plugins``. Comprehensions, lambdas and
generator expressions belong to the function in which they stand; bodies of modules and classes are none.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import subprocess
import sys
from collections import defaultdict
from collections.abc import Sequence
from inspect import CO_OPTIMIZED
from pathlib import Path
from tempfile import TemporaryDirectory
from types import CodeType, FrameType
from typing import Any

from zlmreport.cli import main as run_command

_ROOT = Path(__file__).parents[1]
_OWN = tuple(str(_ROOT / folder) for folder in ("src/zlmreport", "plugins"))
_CONFIGS = _ROOT / "configs"
_CERTIFICATE = (str(_CONFIGS / "linear-axis" / "certificate.yaml"), "--quiet", "--format")
COMMANDS = {
    "readings to their results file": (*_CERTIFICATE, "json"),
    "readings to their page": (*_CERTIFICATE, "html"),
    "a hidden effect to its sentence": ("model", "diagnose", str(_CONFIGS / "hidden-effect" / "job.yaml")),
}


def list_entered(command: Sequence[str]) -> set[CodeType]:
    """Return the own functions that a command enters, where none has been run in this process before."""
    entered: set[CodeType] = set()

    def note(frame: FrameType, event: str, _: Any) -> None:
        if event == "call":
            entered.add(frame.f_code)

    with contextlib.redirect_stdout(io.StringIO()):
        sys.setprofile(note)
        try:
            code = run_command(command)
        finally:
            sys.setprofile(None)
    if code:
        raise RuntimeError(f"{' '.join(command)} ends with {code}")
    return {
        each
        for each in entered
        if each.co_filename.startswith(_OWN) and each.co_flags & CO_OPTIMIZED and each.co_name[0] != "<"
    }


def _name_room(code: CodeType) -> str:
    """Return the room in which a function stands: two folders of ``src/zlmreport``, one of the plugins."""
    parts = Path(code.co_filename).relative_to(_ROOT).parts
    return "/".join(parts[2:-1][:2] if parts[0] == "src" else (parts[0], *parts[2:-1][:1])) or parts[-1]


def _tell(name: str) -> None:
    """Print what a command enters, room by room; this process is its own."""
    with TemporaryDirectory() as folder:
        output = ("--output", folder) if "--format" in COMMANDS[name] else ()
        entered = list_entered([*COMMANDS[name], *output])
    rooms: dict[str, list[CodeType]] = defaultdict(list)
    for each in entered:
        rooms[_name_room(each)].append(each)
    files = len({each.co_filename for each in entered})
    print(f"{name}: {files} files, {len(entered)} functions")
    for room, functions in sorted(rooms.items(), key=lambda each: -len(each[1])):
        print(f"  {len({each.co_filename for each in functions}):4} {len(functions):5}  {room}")


def main(arguments: Sequence[str]) -> None:
    """Print it of each command."""
    parser = argparse.ArgumentParser(prog="./run benchmark hops", description=(__doc__ or "").splitlines()[0])
    parser.add_argument("name", nargs="?", choices=COMMANDS, help="of a command; all of them without it")
    name = parser.parse_args(arguments).name
    if name:
        _tell(name)
        return
    for each in COMMANDS:
        subprocess.run([sys.executable, __file__, each], check=True)


if __name__ == "__main__":
    main(sys.argv[1:])
