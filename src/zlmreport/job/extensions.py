"""The groups of job keys that belong to extensions."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import Any

from pydantic import BaseModel, Field, create_model

from zlmreport.errors import Problem
from zlmreport.job.choices import program_choices
from zlmreport.job.installed import Installed, InstalledExtension
from zlmreport.job.job import ExtensionChoice
from zlmreport.job.tree import Keys, found_at, keys_of
from zlmreport.job.types import JobPart
from zlmreport.job.validate import validate


def group_model(extension: InstalledExtension) -> type[BaseModel]:
    """Return a model whose one key is the group of an extension: as a job has it."""
    field: Any = Field(None, description=extension.description, examples=[dict(extension.example)])
    group: Any = (extension.options | None, field)
    model: type[BaseModel] = create_model(
        f"{extension.options.__name__}Group", __base__=JobPart, **{extension.identifier: group}
    )
    return model


def extension_choices(tree: Keys, registry: Installed, problems: list[Problem]) -> Iterator[ExtensionChoice]:
    """Yield the groups of a job, each with its keys and its part programs; mistakes are added to problems."""
    for name in registry.extension_keys:
        entry = tree.entries.get(name)
        if entry is None:
            continue
        extension = registry.extension(name, entry.place)
        group = validate(group_model(extension), keys_of(tree.place, (entry,)), problems)
        path = (name, *extension.programs)
        programs = program_choices(
            found_at(tree, path) if extension.programs else None,
            partial(registry.part_program, takes=extension.takes),
            problems,
            within=".".join(path),
        )
        options = getattr(group, name, None)
        if options is not None:
            yield ExtensionChoice(name, options, programs)
