"""The questions on a table that ``zlmreport look`` asks its author (sign, unit, direction, grade …)."""

from __future__ import annotations

SIGN_ASKED = (
    "Is the deviation actual − nominal? No file tells; if it is nominal − actual, say sign: nominal-actual."
)
DISAGREE_ASKED = (
    "Is the deviation in line {line} right? It is not the actual position minus the target, as in the other "
    "rows; the deviations are read."
)
UNIT_ASKED = (
    "Are the deviations in {unit}? The table names no unit; {reason}if they are in {other}, say "
    "units: {{deviation: {other}}}."
)
AVERAGES_ASKED = (
    "Is each value the average of several readings, as {name} says? Then no scatter can be had of them, and "
    "a standard would take each for a single reading: evaluate the readings themselves, or use these for an "
    "error model and a compensation table alone."
)
DIRECTION_ASKED = "Were all readings taken upwards? The table names no direction; else say direction: '-'."
INITIALS_ASKED = (
    "Were the readings under {up} and its like taken upwards, and those under {down} downwards? Nothing but "
    "their initials says so."
)
OTHER_DIRECTION_ASKED = (
    "Are the readings of the other direction in {names}? They are not read; if they are, name them in the "
    "job, as in 'columns: {{\"1-\": {first}}}'."
)
SECOND_ASKED = (
    "Were the readings right of the second column of targets taken downwards, and those left of it upwards? "
    "The table names no direction."
)
ORDER_ASKED = (
    "Do the rows stand in the order in which the readings were taken? The table names no direction; it is "
    "told by whether the target rises or falls from row to row."
)
RUNS_ASKED = "Is the n-th reading of a target in a direction of the n-th run? The table names no runs."
RUNS_NOT_READ_ASKED = (
    "Is the n-th reading of a target in a direction of the n-th run? The column {name} is not read."
)
PARTS_ASKED = (
    "Are the {count} tables, one below the other, runs of one test? If they are of several axes, write a "
    "file of each."
)
BELOW_ASKED = (
    "Do the {count} rows of numbers below the table, from line {first} on, belong to the test? They are not "
    "read."
)
ABOVE_ASKED = (
    "Do the {count} rows of numbers above the table, up to line {last}, belong to the test? They are not "
    "read."
)
DECIMAL_ASKED = "Is the decimal sign a {sign}? Every number may as well have its thousands parted by it."
MISSING_ASKED = "Is a reading missing where the table has {words}?"
TIME_ASKED = (
    "The column {name} is not read: {example} may be one day or another. Write the times as ISO 8601."
)
GRADE_ASKED = "Does “Grad” mean degrees? If it means gon, say it under units: {target: gon}."
SHEETS_ASKED = "Is {sheet} the right sheet? {others} {hold} a table, too."
TURN_ASKED = "Does the axis turn? Its targets go over a whole turn; say kind: rotary under axis then."
TEMPERATURE_ASKED = (
    "Whose temperature is {name}? As it is, it is kept and enters nothing; say columns: "
    "{{material_temperature: {name}}}, axis_temperature (the machine's scale) or air_temperature."
)
