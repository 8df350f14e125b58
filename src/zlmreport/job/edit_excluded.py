"""Setting a reading aside in a job, and bringing it back."""

from __future__ import annotations

from pathlib import Path

from zlmreport.errors import Place
from zlmreport.job.edit import Edit, ListChange, edit_list
from zlmreport.job.exclusion_keys import ExclusionKeys
from zlmreport.job.installed import Installed
from zlmreport.job.job import Job
from zlmreport.job.list_edits import ListKey
from zlmreport.job.tree import Entry, Node, Scalar, keys_of

#: The list of readings that a job sets aside.
EXCLUDED = ListKey("measurement", "excluded")


def exclude(path: Path, job: Job, registry: Installed, exclusion: ExclusionKeys) -> Edit:
    """Return the change of a job that sets a reading aside.

    Raises
    ------
    InputError
        If the file has changed since it was loaded, or is written in a way in which nothing can be changed
        without changing more.
    AccessError
        If the file cannot be read.
    """
    wanted = [*job.keys.measurement.excluded, exclusion]
    change = ListChange(EXCLUDED, added=[_node(exclusion)])
    return edit_list(path, job, registry, change, lambda after: after.keys.measurement.excluded == wanted)


def include(path: Path, job: Job, registry: Installed, index: int) -> Edit:
    """Return the change of a job that brings a reading back: the one that the list names at an index.

    Raises
    ------
    InputError, AccessError
        As for `exclude`.
    """
    wanted = [each for number, each in enumerate(job.keys.measurement.excluded) if number != index]
    change = ListChange(EXCLUDED, removed=[index])
    return edit_list(path, job, registry, change, lambda after: after.keys.measurement.excluded == wanted)


def _node(exclusion: ExclusionKeys) -> Node:
    place = Place("")
    values = {
        "target": Scalar(place, f"{exclusion.target:.10g}"),
        "direction": Scalar(place, exclusion.direction, plain=False),
        "run": Scalar(place, str(exclusion.run)),
        "reason": Scalar(place, exclusion.reason, plain=False),
    }
    return keys_of(place, tuple(Entry(key, place, value) for key, value in values.items()))
