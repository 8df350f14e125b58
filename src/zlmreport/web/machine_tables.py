"""What the page of a machine does with tables across axes: a forecast, a trial, files, circles run again."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from zlmreport.document.blocks import Section
from zlmreport.errors import InputError
from zlmreport.files import Document, write_new
from zlmreport.language import Language
from zlmreport.machines.cross_confirmation import confirm
from zlmreport.machines.cross_making import (
    CrossWanted,
    list_cross_controls,
    make_cross,
    make_table_documents,
    make_trial,
)
from zlmreport.machines.cross_tables import plan_worthwhile
from zlmreport.machines.subjects.cross_tables import lay_out_confirmation, lay_out_cross, lay_out_trial
from zlmreport.machines.subjects.saying import Sayer
from zlmreport.measurement.units import MILLIMETRE
from zlmreport.web.bench import PLACE
from zlmreport.web.blocks import list_all_sections
from zlmreport.web.changes import ShortText
from zlmreport.web.commands import list_siblings
from zlmreport.web.machine_bench import LoadedMachine, MachineBench
from zlmreport.web.naming import Naming

_MOST_CIRCLES = 20


class TablesWanted(BaseModel):
    """What a page wants of tables across axes, as it sends it."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    action: Literal["forecast", "trial", "write", "confirm"]
    controller: ShortText  #: For which control.
    #: Which way a positive value moves an axis; empty where that is known.
    moves: Literal["", "plus", "minus"] = ""
    #: Between rows, mm; without it as measured.
    step: float | None = Field(None, gt=0, allow_inf_nan=False)
    #: Of the confirmation: files of the circles' jobs, in the folder of the machine file.
    circles: tuple[ShortText, ...] = Field((), max_length=_MOST_CIRCLES)


def list_offered_tables(bench: MachineBench, loaded: LoadedMachine, language: Language) -> Mapping[str, Any]:
    """Return the controls and circles that a page offers; nothing where no error is worth a table."""
    if plan_worthwhile(loaded.machine.machine) is None:
        return {}
    return {
        "controllers": [
            {
                "controller": each.identifier,
                "title": each.title.in_language(language),
                "isSignKnown": each.cross_sign == "known",
            }
            for each in list_cross_controls(bench.registry)
        ],
        "circles": list_siblings(bench.path),
    }


def make_tables(
    bench: MachineBench, loaded: LoadedMachine, wanted: TablesWanted, names: Naming
) -> tuple[dict[str, Any], list[Document]]:
    """Return what is said of tables, and the files that were written beside the machine file.

    Raises `InputError` if the control takes no such tables, or a circle is none that the page offered;
    `AccessError` if a file is there already, or cannot be written.
    """
    machine, registry, say = loaded.machine, bench.registry, Sayer(names.language)
    step = None if wanted.step is None else MILLIMETRE.to_si(wanted.step)
    asked = CrossWanted(wanted.controller, wanted.moves or None, step, PLACE, is_command=False)
    sections: list[Section]
    documents: list[Document] = []
    folder = bench.path.resolve().parent
    if wanted.action == "trial":
        _, table, files = make_trial(machine, registry, asked)
        sections = [lay_out_trial(table, say)]
        documents = make_table_documents(files, folder, f"{machine.number}-trial")
    else:
        made = make_cross(machine, registry, asked)
        if wanted.action == "confirm":
            offered = list_siblings(bench.path)
            for name in wanted.circles:
                if name not in offered:
                    raise InputError.at(PLACE, f"there is no job {name[:60]!r}")
            jobs = [folder / name for name in wanted.circles]
            sections = [lay_out_confirmation(confirm(machine, made, jobs, registry, PLACE), say)]
        else:
            sections = lay_out_cross(made, say)
        if wanted.action == "write":
            documents = make_table_documents(made.files, folder, machine.number)
    write_new(documents)
    values = {
        "stamp": loaded.stamp,
        "action": wanted.action,
        "sections": list_all_sections(sections, names),
        "files": [each.path.name for each in documents],
    }
    return values, documents
