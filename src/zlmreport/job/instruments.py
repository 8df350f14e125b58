"""The live instrument that a data source's keys name, with its own keys."""

from __future__ import annotations

from dataclasses import dataclass, replace

from pydantic import BaseModel, ConfigDict, Field

from zlmreport.errors import InputError, Place, Problem
from zlmreport.job.fields import keys_in, model_in
from zlmreport.job.installed import Installed
from zlmreport.job.options import Options
from zlmreport.job.tree import Keys, Scalar
from zlmreport.job.types import Text
from zlmreport.job.validate import validate


class LiveInstrumentKeys(BaseModel):
    """A live instrument; its own keys follow `plugin`. A data source that has one declares a key of it."""

    model_config = ConfigDict(extra="allow", frozen=True)

    plugin: Text = Field(description="Identifier of an installed live instrument.", examples=["umd1"])


@dataclass(frozen=True, slots=True)
class InstrumentChoice:
    """A live instrument that the job names, its own keys validated, and where the job names it."""

    identifier: str
    options: Options
    place: Place


def instrument_choice(
    source: type[Options], keys: Keys, registry: Installed, problems: list[Problem], *, within: str
) -> InstrumentChoice | None:
    """Return the live instrument that the keys of a data source name; None if they name none.

    Parameters
    ----------
    source
        The keys that the data source knows.
    keys
        What the job says.
    registry
        The installed plugins.
    problems
        Where mistakes are added.
    within
        The dotted path of the data source, for messages.
    """
    key = next(
        (key for key, field in keys_in(source).items() if model_in(field.annotation) is LiveInstrumentKeys),
        "",
    )
    entry = keys.entries.get(key)
    if entry is None or not isinstance(entry.value, Keys):
        return None
    named = entry.value.entries.get("plugin")
    if named is None or not isinstance(named.value, Scalar) or named.value.is_nothing:
        return None
    place = named.value.place
    try:
        instrument = registry.instrument(named.value.text, place)
    except InputError as error:
        problems.extend(error.problems)
        return None
    own = replace(entry.value.without("plugin"), place=place)
    options = validate(instrument.options, own, problems, within=f"{within}.{key}", also_known=["plugin"])
    return InstrumentChoice(instrument.identifier, options, place) if options else None
