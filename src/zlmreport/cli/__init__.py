"""Starts each command by its module; exit codes after Ctrl-C, of a closed pipe, of errors.

This module is all that ``--version`` and ``--help`` load; a command's own module, and with it all that is
slow to load, comes when the command is given.
"""

from __future__ import annotations

import atexit
import gc
import importlib
import os
import sys
from collections.abc import Sequence
from typing import TextIO

from zlmreport.cli.arguments import parse
from zlmreport.cli.terminal import print_problems
from zlmreport.cli.watch import watch
from zlmreport.errors import AccessError, ZlmreportError
from zlmreport.files import confine, say_reason

#: What a shell sees of a program that these signals ended.
_INTERRUPTED = 128 + 2
_BROKEN_PIPE = 128 + 13
#: Commands that stand with others in a module, each as a function of its last word.
_TOGETHER = {
    "check": "report",
    "fleet backup": "fleet_ledger",
    "fleet rebuild": "fleet_ledger",
    "fleet report": "fleet_ledger",
    "look": "init",
    "schema": "plugins",
}


def watched_main() -> int:
    """Do what the command line says, watched by another process; return the exit code."""
    _settle_collector()
    # who completes a line ends the process by himself, and loads no plugin of anybody
    code = None if "_ARGCOMPLETE" in os.environ else watch(main)
    return main() if code is None else code


def main(arguments: Sequence[str] | None = None) -> int:
    """Do what the command line says and return the exit code; messages go to the standard error output."""
    _settle_environment()
    _settle_collector()
    for stream in (sys.stdout, sys.stderr):
        _write_what_cannot_be_encoded_as_escapes(stream)
    options = None
    try:
        if "_ARGCOMPLETE" in os.environ:
            importlib.import_module("zlmreport.cli.completion").complete()
        command, options = parse(sys.argv[1:] if arguments is None else arguments)
        module = importlib.import_module(f"zlmreport.cli.{_TOGETHER.get(command, command)}")
        run = getattr(module, command.split()[-1] if command in _TOGETHER else "run")
        with confine(options.confine):
            code: int = run(options)
        sys.stdout.flush()
    except SystemExit:  # by argparse, after --help and --version
        return 0 if options is None else ZlmreportError.exit_code
    except ZlmreportError as error:
        job = getattr(options, "job", None)  # a command that works on several has told of each
        print_problems(error.of_job(job) if job else error)
        return error.exit_code
    except BrokenPipeError:
        _forget_standard_output()
        return _BROKEN_PIPE
    except KeyboardInterrupt:
        return _INTERRUPTED
    except OSError as error:
        _forget_standard_output()
        where = error.filename or "the standard output"
        print(f"{where}: cannot be read or written: {say_reason(error)}", file=sys.stderr)
        return AccessError.exit_code
    return code


def _settle_environment() -> None:
    """Say what libraries ask the environment for while they are loaded: to be called before that."""
    # On the small matrices of a test, threads only wait for each other, and a diagnosis takes ten times as
    # long beside other processes.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    # Pydantic looks for plugins of its own among all distributions before it makes its first model.
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")


def _settle_collector() -> None:
    """Leave alone what is loaded and made at the beginning: it stays, and goes with the process.

    The collector of garbage would walk it again and again for nothing, and at the end most of all. A run that
    writes results alone makes 110,000 objects that stay.
    """
    gc.set_threshold(200_000)
    atexit.register(gc.freeze)


def _write_what_cannot_be_encoded_as_escapes(stream: TextIO) -> None:
    """Let no letter of a name end the program on a terminal that does not have it."""
    reconfigure = getattr(stream, "reconfigure", None)
    if reconfigure:
        reconfigure(errors="backslashreplace")


def _forget_standard_output() -> None:
    """Nobody reads on: let the interpreter not try to write the rest when it ends."""
    sink = os.open(os.devnull, os.O_WRONLY)
    os.dup2(sink, sys.stdout.fileno())
    os.close(sink)
