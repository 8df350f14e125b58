"""The door of large plugins that bring job keys, commands, plans and budgets of their own."""

from __future__ import annotations

from zlmreport.evaluation.uncertainty.budget import (
    Acts,
    Contribution,
    Distribution,
    write_of_the_reading as of_the_reading,
)
from zlmreport.evaluation.uncertainty.expanded import (
    add_uncertainty as with_uncertainty,
)
from zlmreport.evaluation.uncertainty.wording import (
    STATED as STATED_IN_THE_JOB,
    USUAL as USUAL_CONTRIBUTIONS,
    say_calibration as calibration_in_words,
    say_expanded_uncertainty as expanded_uncertainty_in_words,
)
from zlmreport.files import (
    JournalFile,
    make_unwritable as unwritable,
    take_names,
)
from zlmreport.job.evaluation_keys import (
    STATED_COVERAGE_FACTOR,
    ProgramKeys,
)
from zlmreport.job.extends import (
    FileFormat,
)
from zlmreport.job.job import (
    Job,
)
from zlmreport.job.keys import (
    JobKeys,
)
from zlmreport.job.keys_file import KeysFile, read_keys_file
from zlmreport.job.measurement_keys import (
    InstrumentKeys as JobInstrument,
)
from zlmreport.job.parse import is_named_as_yaml
from zlmreport.job.tree import (
    Step as KeyStep,
)
from zlmreport.plugin.extending import (
    Command,
    CommandHost,
    CommandOption,
    Extension,
    ExtensionPlan,
    Happening,
    LiveRun,
)

__all__ = [
    "STATED_COVERAGE_FACTOR",
    "STATED_IN_THE_JOB",
    "USUAL_CONTRIBUTIONS",
    "Acts",
    "Command",
    "CommandHost",
    "CommandOption",
    "Contribution",
    "Distribution",
    "Extension",
    "ExtensionPlan",
    "FileFormat",
    "Happening",
    "Job",
    "JobInstrument",
    "JobKeys",
    "JournalFile",
    "KeyStep",
    "KeysFile",
    "LiveRun",
    "ProgramKeys",
    "calibration_in_words",
    "expanded_uncertainty_in_words",
    "is_named_as_yaml",
    "of_the_reading",
    "read_keys_file",
    "take_names",
    "unwritable",
    "with_uncertainty",
]
