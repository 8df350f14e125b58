"""The doors: all that a plugin imports of zlmreport.

Here stands what every plugin needs; what only one kind needs stands in the door of that kind: `standard`,
`source`, `table`, `renderer`, `page`, `html`, `effect`, `circle_effect`, `instrument`, `program`,
`controller`, `notifier`, `extension`. A standard that needs nothing special imports a dozen names.
"""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING

from zlmreport.document.figures.figure import (
    Figure,
)
from zlmreport.errors import (
    AccessError,
    InputError,
    Place,
    Problem,
    count_in_words as counted,
    did_you_mean,
    list_names as listed,
    quoted,
)
from zlmreport.evaluation.evaluation import (
    Evaluation,
)
from zlmreport.job.circle_keys import (
    CircleKeys,
)
from zlmreport.job.types import (
    Date,
    Finite,
    JobPart,
    JobPath,
    NotNegative,
    Options,
    Positive,
    Text as TextLine,
)
from zlmreport.language import (
    Language,
    PartRow,
    Words,
    named,
    same as same_in_all_languages,
)
from zlmreport.language.formatting import (
    MINUS as MINUS_SIGN,
    DecimalSign,
    hold_together as held_together,
    write_fixed_number as fixed_number,
    write_general_number as general_number,
)
from zlmreport.measurement.approach import (
    Approach,
)
from zlmreport.measurement.arrays import (
    BoolArray,
    FloatArray,
    IntArray,
    read_only_floats,
)
from zlmreport.measurement.axis import (
    Axis,
    AxisKind,
    list_position_units as position_units,
)
from zlmreport.measurement.circle import (
    NominalCircle,
)
from zlmreport.measurement.error_symbol import (
    ErrorSymbol,
    find_error_named as error_named,
)
from zlmreport.measurement.measurand import (
    ANGLE,
    CIRCLE,
    DISPLACEMENT,
    POSITIONING,
    ROTARY_POSITIONING,
    SQUARENESS,
    STRAIGHTNESS,
    Coordinate,
    Measurand,
    list_measurands_of as measurands_of,
)
from zlmreport.measurement.measurement_set import (
    CONDITION_NAMES,
    CONDITIONS,
    STATE_OF_AIR,
    MeasurementSet,
)
from zlmreport.measurement.units import (
    ANGLE_UNITS,
    ARCSECOND,
    CELSIUS,
    DEGREE,
    HECTOPASCAL,
    HOUR,
    INCH,
    LENGTH_UNITS,
    MICROMETRE,
    MICROMETRE_PER_METRE,
    MICROMETRE_PER_METRE_KELVIN,
    MICRORADIAN,
    MILLIMETRE,
    MILLIRADIAN,
    PERCENT,
    POSITION_UNITS,
    REFERENCE_TEMPERATURE,
    SECOND,
    TIME_UNITS,
    Scale as ReadingScale,
    Unit,
    compute_above_reference as above_reference_temperature,
    find_unit_named as unit_named,
)
from zlmreport.plugin.hooks import (
    hookimpl,
)

#: The doors by what an author builds.
DOORS = (
    "standard",
    "source",
    "table",
    "renderer",
    "page",
    "html",
    "effect",
    "circle_effect",
    "instrument",
    "program",
    "controller",
    "notifier",
    "extension",
)

__all__ = [
    "ANGLE",
    "ANGLE_UNITS",
    "ARCSECOND",
    "CELSIUS",
    "CIRCLE",
    "CONDITIONS",
    "CONDITION_NAMES",
    "DEGREE",
    "DISPLACEMENT",
    "DOORS",
    "HECTOPASCAL",
    "HOUR",
    "INCH",
    "LENGTH_UNITS",
    "MICROMETRE",
    "MICROMETRE_PER_METRE",
    "MICROMETRE_PER_METRE_KELVIN",
    "MICRORADIAN",
    "MILLIMETRE",
    "MILLIRADIAN",
    "MINUS_SIGN",
    "PERCENT",
    "POSITIONING",
    "POSITION_UNITS",
    "REFERENCE_TEMPERATURE",
    "ROTARY_POSITIONING",
    "SECOND",
    "SQUARENESS",
    "STATE_OF_AIR",
    "STRAIGHTNESS",
    "TIME_UNITS",
    "AccessError",
    "Approach",
    "Axis",
    "AxisKind",
    "BoolArray",
    "CircleKeys",
    "Coordinate",
    "Date",
    "DecimalSign",
    "ErrorSymbol",
    "Evaluation",
    "Figure",
    "Finite",
    "FloatArray",
    "InputError",
    "IntArray",
    "JobPart",
    "JobPath",
    "Language",
    "Measurand",
    "MeasurementSet",
    "NominalCircle",
    "NotNegative",
    "Options",
    "PartRow",
    "Place",
    "Positive",
    "Problem",
    "ReadingScale",
    "TextLine",
    "Unit",
    "Words",
    "above_reference_temperature",
    "counted",
    "did_you_mean",
    "error_named",
    "fixed_number",
    "general_number",
    "held_together",
    "hookimpl",
    "listed",
    "measurands_of",
    "named",
    "position_units",
    "quoted",
    "read_only_floats",
    "same_in_all_languages",
    "unit_named",
]

if not TYPE_CHECKING:

    def __getattr__(name: str) -> object:
        """Return a name of another door: before 0.3 all of them stood here, and do until 0.4."""
        if not name.startswith("_") and not find_spec(
            f"{__name__}.{name}"
        ):  # a module of ours is no name of a door
            for door in DOORS:
                module = import_module(f"{__name__}.{door}")
                if name in module.__all__:
                    return getattr(module, name)
        message = f"module {__name__!r} has no attribute {name!r}"
        raise AttributeError(message)
