"""Keys of a job file that belong to a plugin, and how a plugin declares them."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

from pydantic import BaseModel, BeforeValidator, ConfigDict

from zlmreport.job.located import LocatedText
from zlmreport.job.references import path_named


class Options(BaseModel):
    """The base of every plugin's own job keys.

    A plugin subclasses it and declares one field a key, with a type, a default if it has one, and a
    `description`. Unknown keys are refused, and every mistake is reported with the line and column in
    the job file; ``zlmreport schema`` shows the keys to editors.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, arbitrary_types_allowed=True)


def _beside_the_naming_file(value: Any) -> Any:
    """Resolve a relative path against the folder of the file that names it."""
    if not value:
        raise ValueError("the name of a file is expected")
    if isinstance(value, LocatedText):
        return path_named(str(value), Path(value.place.file))
    return value


#: A path in a job file: relative to the file that names it, which may be one that the job extends.
JobPath = Annotated[Path, BeforeValidator(_beside_the_naming_file)]
