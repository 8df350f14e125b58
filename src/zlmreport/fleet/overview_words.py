"""Every phrase of the overview: headings, captions, columns, explanations."""

from __future__ import annotations

from zlmreport.fleet.records import About
from zlmreport.language import Words

TITLE = Words("Fleet overview")

# Headline

LAST_RUN = Words("Last run")
NEVER = Words("not yet")
INTERRUPTED = Words("{began}, interrupted")
AT_WORK = Words("{began}, at work: {number} job so far", plural="{began}, at work: {number} jobs so far")
RAN = Words("{began}, {duration}")
SECONDS = Words("{number} s")
MINUTES = Words("{minutes} min {seconds} s")
JOBS = Words("Jobs")
JOBS_DONE = Words("{jobs}: {made} made, {unchanged} unchanged, {drafts}, {failed} failed")
JOBS_LEFT = Words("{done}, {number} left for lack of time")
AS_DRAFTS = Words("{number} as a draft", plural="{number} as drafts")
CERTIFICATES = Words("Certificates")
HEADLINE = Words("The fleet in numbers")
AXES = Words("Axes")

# What needs you

NEEDS = Words("What needs you")
NOTHING = Words(
    "Nothing: every job was made, every limit that is stated is met, no parameter drifts, and no test "
    "is overdue."
)
NO_NIGHT = Words("The ledger is empty: the fleet has not run yet.")
NOTICED = Words("Notices on the run")
NOTICED_CAPTION = Words("What concerns the last run as a whole")
ABOUT = Words("About")
ABOUTS = {
    About.JOBS: Words("Jobs are missing"),
    About.FOLDER: Words("Folder of certificates"),
    About.LEDGER: Words("Ledger"),
    About.CLOCK: Words("Clock"),
    About.UNTOLD: Words("News that was not sent"),
    About.PRIORS: Words("Priors from the tests"),
    About.STUCK: Words("A run that hung"),
    About.BROKEN: Words("A run that was broken off"),
    About.LEFT: Words("Jobs that are left"),
    About.DOCUMENTS: Words("Issued certificates"),
}
FAILED = Words("Failed")
FAILED_CAPTION = Words(
    "Jobs of which no certificate could be made, or whose file is gone; the next run tries again what is not "
    "set aside"
)
OVERDUE = Words("Overdue")
OVERDUE_CAPTION = Words("Axes that should have been measured again by now")
DUE_SOON = Words("Due soon")
DUE_CAPTION = Words("Axes that are to be measured within {days} days of the last run")
NOTHING_DUE = Words("Nothing is due within {days} days of the last run.")
SHARED = Words("Shared by machines of one type")
SHARED_CAPTION = Words(
    "Parameters of the error model whose mean over {least} or more machines of a type is not zero: the "
    "cause is in their construction or common set-up rather than in one machine"
)
TYPE = Words("Axis and type")
EFFECT = Words("Effect")
MEAN = Words("Mean ± U")
MACHINES_OF_TYPE = Words("Machines")
MEASURED_ON = Words("Measured")
DUE = Words("Due")
NOT_MET = Words("Limit not met")
NOT_MET_CAPTION = Words("Parameters whose latest certificate states that the limit is not met")
UNDECIDED = Words("Undecided")
UNDECIDED_CAPTION = Words("Parameters so near to their limit that the decision rule states nothing")
DOUBTFUL = Words("Doubtful")
DOUBTFUL_CAPTION = Words(
    "Axes whose latest certificate has readings or units that look wrong: where they are, correct the job or "
    "its readings and issue an amendment; where they are right, nothing is to be done"
)
CHANGED = Words("Changed")
CHANGED_CAPTION = Words(
    "Parameters of which the latest test shows a step, or whose latest tests scatter more than before"
)
DRIFTING = Words("Drifting")
DRIFTING_CAPTION = Words("Parameters that drift, those first that meet their limit soonest")
DRAFTS = Words("Drafts")
DRAFTS_CAPTION = Words(
    "Contents that differ from what was issued under their number: issue an amendment, or undo the change"
)

# Machines

MACHINES = Words("Machines and axes")
MACHINE_CAPTION = Words("Latest values and their course since {first}")
LARGE_CAPTION = Words(
    "Latest values and their course since {first}; graphs of what needs nobody are drawn when they come in "
    "sight"
)
NO_MACHINE = Words("Machine not named")
COUNTED_AXES = Words("{number} axis", plural="{number} axes")
DUE_ON = Words("due {due}")
SEARCH = Words("Search machine, axis or certificate")
CHOICE = Words("Show")
ALL_AXES = Words("All axes")
ORDER = Words("In the order of")
BY_MACHINE = Words("machine and axis")
BY_USE = Words("share of the limit, largest first")
BY_DUE = Words("date by which it is due")
BY_MEASURED = Words("last measurement, oldest first")
FOUND = Words("{shown} of {number} axis", plural="{shown} of {number} axes")

# Columns

JOB = Words("Job")
MESSAGE = Words("What is wrong")
DOUBT = Words("What is doubtful")
SINCE = Words("Since")
AXIS = Words("Axis")
PARAMETER = Words("Parameter")
VALUE = Words("Value ± U")
LIMIT = Words("Limit")
STATE = Words("State")
COURSE = Words("Course")
DRIFT = Words("Drift ± U")
CHANGE = Words("Change")
CHANGE_OR_DRIFT = Words("Change, drift")
CAME_WITH = Words("What changed with it")
REACHED = Words("Limit reached")
CERTIFICATE = Words("Certificate")
REASON = Words("Why")

# States

MET = Words("met", context="limit")
IS_NOT_MET = Words("not met", context="limit")
IS_OPEN = Words("undecided")
NO_LIMIT = Words("no limit")

# Trends in full

CLOSE = Words("Back to the fleet")
TREND = Words("{axis} of {machine}")
TESTS = Words("Tests")
TESTS_CAPTION = Words("Every test that counts, the latest first")
CHANGE_FACT = Words("Change")
DRIFT_FACT = Words("Drift")
EFFECTS = Words("Effects")
EFFECTS_CAPTION = Words("Parameters of this axis’s error model, by the latest test")
INSTRUMENT_USED = Words("Instrument")

# Steps

STEP_SINCE = Words("since {since}; a step with {percent} %")
WILDER = Words("scatters more")
VISIBLE = Words("a step of {size} would be seen")
INSTRUMENT = Words("{after} in place of {before}")

# Drift

PER_YEAR = Words("{change}/year")
CHANCE = Words("{p}; {number} calibration", plural="{p}; {number} calibrations")
ALSO = Words("also {symbols}, without a limit")
WITHOUT_LIMIT = Words("no limit stated")
BETWEEN = Words("95 %: {earliest} to {latest}")
NOT_BEFORE = Words("95 %: not before {earliest}")
EARLIER = Words("before the first date")
GETS_SMALLER = Words("moves away from it")
FAR_AWAY = Words("not within {years} years")
TOO_FEW = Words("{number} of {least} dates")
STEADY = Words("none found")

# How to read it

READING = Words("How to read this page")
TERM_VALUE = Words("Diamonds and line")
MEANING_VALUE = Words("the certified values, the last one larger; a cross where the limit was not met")
TERM_BAND = Words("Shaded band")
MEANING_BAND = Words("their expanded uncertainty")
TERM_LIMIT = Words("Dashed line")
MEANING_LIMIT = Words("the limit; the graph stands on zero")
TERM_STEP = Words("Dotted upright line")
MEANING_STEP = Words("a step: what was before has no part in a drift")
TERM_DRIFT = Words("Dash-dotted line")
MEANING_DRIFT = Words("a drift, and where it leads")
STEP_METHOD = Words(
    "A step is named if the latest test differs from the mean of those before it by more than the scatter "
    "between tests explains. Where {least} or more came before, a step of {scatters} scatters is seen at "
    "once in 95 % of all cases, and one test in {alarms}, or fewer, raises a false alarm. What is less than "
    "{small} % of the limit is no news, as a step or as a drift."
)
DRIFT_METHOD = Words(
    "A parameter drifts if a weighted regression through {least} or more dates is steeper than its "
    "scatter explains (Student’s t), and the order of the values bears it out (Mann and Kendall). All tests "
    "of the fleet are judged together: of the axes that are named, no more than {share} % are expected to be "
    "named by accident (Benjamini and Hochberg over the axes, Holm within an axis)."
)
FORECAST_METHOD = Words(
    "A limit is reached where the line meets it, within the 95 % interval. That holds as long as the axis "
    "goes on as it has done, and nobody adjusts it."
)
ALTERNATIVE = Words(
    "{number} value of {symbol}, of {last}: {value}.",
    plural="{number} values of {symbol} from {first} to {last}, the last {value}.",
)
ALTERNATIVE_LIMIT = Words(" Limit {limit}.")
ALTERNATIVE_DRIFT = Words(" Drift {change}/year.")
SAMPLE = Words("An example of the small graphs, explained beside it.")
