"""The fixed words of the workbench: headings, buttons, labels, what is said while something is made."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from zlmreport.document.subjects.compensation import CONFIRMED
from zlmreport.document.subjects.diagnosis import CANDIDATES, VERDICT
from zlmreport.document.subjects.fit import EFFECTS, FLOOR
from zlmreport.document.subjects.forecast import FALL
from zlmreport.document.subjects.linked import GRAPH_TEXTS
from zlmreport.language import Language, Words
from zlmreport.machines.subjects.cross_tables import TABLES
from zlmreport.model.compensation.confirmation import ConfirmationVerdict

TITLE = Words("Workbench")
NO_SCRIPT = Words("The workbench needs JavaScript, which comes from this computer alone.")
_CONFIRMED = {
    ConfirmationVerdict.HELD: "held",
    ConfirmationVerdict.WRONG_SIGN: "wrongSign",
    ConfirmationVerdict.HALF: "half",
    ConfirmationVerdict.SHIFTED: "shifted",
    ConfirmationVerdict.OTHER: "otherTable",
}
TEXTS: Mapping[str, Words] = MappingProxyType(
    {
        **GRAPH_TEXTS,
        "capture": Words("Capture"),
        "captureOf": Words("Readings are taken along the plan, into {journal}."),
        "captureBegin": Words("Begin"),
        "captureGoOn": Words("Go on"),
        "captureStop": Words("Interrupt"),
        "captureClose": Words("Close it as it is"),
        "captureCloseHelp": Words("What was not taken is missing."),
        "captureSkip": Words("Skip visit {number}"),
        "captureBack": Words("Take the last one again"),
        "captureRetake": Words("Again"),
        "captureRetakeOf": Words("Take visit {number} again"),
        "captureRunAgain": Words("Run {run} again"),
        "captureComment": Words("Comment"),
        "captureNote": Words("Note it"),
        "captureDone": Words("Done, go on"),
        "captureWaits": Words("Waiting for the instrument …"),
        "captureNoDatum": Words("Waiting for the datum"),
        "captureToGo": Words("{way} to go"),
        "captureRange": Words("range {range}"),
        "captureStill": Words("Standstill"),
        "captureTaken": Words("{taken} of {planned} taken"),
        "captureMinutes": Words("about {minutes} min to go"),
        "captureOver": Words("All visits are taken. The certificate can be made."),
        "captureOpen": Words("To the results"),
        "captureVisit": Words("Visit"),
        "captureRun": Words("Run"),
        "captureTarget": Words("Target"),
        "captureDeviation": Words("Deviation"),
        "captureSpread": Words("Range", context="of readings"),
        "captureState": Words("State", context="standing"),
        "captureIsTaken": Words("taken"),
        "captureIsNext": Words("next"),
        "captureIsOpen": Words("to come"),
        "captureIsSkipped": Words("left out"),
        "captureIsMissed": Words("missing"),
        "captureEvents": Words("What happened"),
        "verdict": VERDICT,
        "candidates": CANDIDATES,
        "otherEffect": Words("Add another effect"),
        "fall": FALL,
        "model": EFFECTS,
        "noEffects": Words("The model has no effect yet. Begin with offset."),
        "standards": Words("What the standards say"),
        "certificate": Words("Certificate"),
        "makeCertificate": Words("Make the certificate"),
        "making": Words("The certificate is being made …"),
        "formats": Words("Formats"),
        "lacking": Words("A calibration certificate must state these too; the job does not yet."),
        "orNegligible": Words("or negligible because"),
        "atLaboratory": Words("at the laboratory"),
        "atCustomer": Words("at the customer's"),
        "page": Words("Page {page} of {pages}"),
        "sheetPage": Words("Sheet: page {page} of {pages}"),
        "pageBefore": Words("The page before"),
        "pageAfter": Words("The next page"),
        "compensation": Words("Compensation table"),
        "whichTable": Words(
            "Which table was active during this test? A new one on top of one that nobody knows corrects "
            "twice. Name its file as axis.compensation_table in the job, or:"
        ),
        "noTable": Words("None was active"),
        "controller": Words("Control"),
        "untried": Words("{controller} (never tried on it)"),
        "step": Words("Rows every"),
        "atTargets": Words("at targets"),
        "unconfirmed": Words("write it even if never tried"),
        "writeTable": Words("Write the table"),
        "writing": Words("The table is being written …"),
        "withTable": Words("With the table"),
        "betweenRows": Words("Between its {rows} rows up to {largest} are left, at {at}."),
        "noMeasurement": Words(
            "A forecast is no measurement: the axis with its table needs a test of its own."
        ),
        "secondTest": Words("Second test"),
        "hold": Words("Hold it against the table"),
        "holding": Words("The two tests are being compared …"),
        **{name: CONFIRMED[verdict] for verdict, name in _CONFIRMED.items()},
        "left": Words("E is {share} % of what it was."),
        "tests": Words("Tests of this axis"),
        "thisTest": Words("this page"),
        "difference": Words("Difference to this test"),
        "differenceIs": Words(
            "Mean deviation of the other test less that of this one; straight between its targets."
        ),
        "overDays": Words("over the tests, with U"),
        "models": Words("The models side by side"),
        "excluded": Words("Readings set aside"),
        "changes": Words("Steps so far"),
        "noChanges": Words("None on this page yet."),
        "undo": Words("Undo"),
        "redo": Words("Redo"),
        "redoOf": Words("Redo: {step}"),
        "ask": Words("Tell me this length, and I can test {effects} as well."),
        "state": Words("Save into the job"),
        "faults": Words("The data look wrong"),
        "remedy": Words("Remedy"),
        "before": Words("before this step"),
        "after": Words("after this step: {step}"),
        "undoOf": Words("Undo: {step}"),
        "add": Words("Add"),
        "addEffect": Words("Add {effect} to the model"),
        "remove": Words("Remove"),
        "removeEffect": Words("Remove {effect} from the model"),
        "fix": Words("Fix"),
        "fixParameter": Words("Fix {parameter} at this value"),
        "free": Words("Free"),
        "freeParameter": Words("Estimate {parameter} from the readings"),
        "probability": Words("Probability"),
        "errorAfter": Words("Error after it"),
        "alike": Words("These readings cannot tell them apart."),
        "equals": Words("Not to be told from"),
        "tell": Words("What would tell them apart"),
        "experiment": Words("The next experiment"),
        "writeJob": Words("Write its job"),
        "simulating": Words("Plans are being simulated …"),
        "diagnosing": Words("Every installed effect is being tried …"),
        "stop": Words("Stop"),
        "stopped": Words("The diagnosis was stopped."),
        "diagnose": Words("Diagnose"),
        "seconds": Words("{seconds} s"),
        "underWay": Words("{share} %, {seconds} s"),
        "working": Words("Working …"),
        "setAside": Words("Set this reading aside"),
        "setAllAside": Words("Set these readings aside"),
        "reason": Words("Reason, as the certificate will state it"),
        "bringBack": Words("Bring back"),
        "noiseFloor": FLOOR,
        "noiseFloorIs": Words(
            "The scatter of readings repeated at one target in one direction: no model gets below it, and"
            " a good one nearly down to it."
        ),
        "pIs": Words("The chance that noise alone would look so. The smaller, the surer it is no accident."),
        "uIs": Words("Expanded uncertainty of the value, as the certificate states it."),
        "jobs": Words("Jobs of this folder"),
        "earlier": Words("Earlier tests of these axes"),
        "allJobs": Words("All jobs"),
        "job": Words("Job"),
        "axis": Words("Axis"),
        "measuredOn": Words("Measured"),
        "dueOn": Words("Due"),
        "jobState": Words("State", context="standing"),
        "oneWave": Words("One wave"),
        "build": Words("Build the model"),
        "building": Words("Diagnosis after diagnosis; nothing is written …"),
        "stairs": Words("Step by step"),
        "stairsAre": Words("A step is written when you take it. Stop at any; each can be taken back."),
        "noStairs": Words("There is no step with evidence of its own."),
        "takeStep": Words("Take this step"),
        "upToHere": Words("Up to here"),
        "stepBack": Words("One step back"),
        "lookAtPages": Words("Look at the pages"),
        "parameter": Words("Parameter"),
        "now": Words("Now"),
        "limit": Words("Limit"),
        "byTable": Words("Compensated by a table"),
        "byModel": Words("By the whole model"),
        "forecast": Words(
            "The last two columns are forecasts: the readings of this test less what the model explains."
        ),
        "outside": Words("The job was changed outside of this page; it shows the job as it is now."),
        "broken": Words(
            "The job cannot be read as it is. Mend it in the editor; this page goes on by itself."
        ),
        "gone": Words("zlmreport no longer answers. Start it again on the terminal: zlmreport workbench."),
        "close": Words("Close"),
        "hidden": Words("What this test cannot see"),
        "notExcluded": Words("Not excluded, for they could not be tried"),
        "remarks": Words("Taken for granted"),
        "outOfDate": Words("Made before the last step: make it again."),
        "back": Words("Back to the workbench"),
        "equation": Words("Equation"),
        "look": Words("Its look in the residuals"),
        "parameters": Words("Parameters", context="model"),
        "range": Words("Plausible"),
        "rangesFrom": Words("Plausible ranges: {source}."),
        "estimated": Words("In this model"),
        "keys": Words("Keys in a job"),
        "confusions": Words("What it is taken for"),
        "contains": Words("It contains {effects}, which cannot stand beside it in a model."),
        "language": Words("Language"),
    }
)

#: What the page of a machine says otherwise, or besides.
MACHINE_TEXTS: Mapping[str, Words] = MappingProxyType(
    {
        "measured": Words("Measured against axes and effects"),
        "model": Words("Effects of drives and structure"),
        "noEffects": Words("The model has no effect yet. Begin with centre-offset and radius."),
        "failures": Words("Where it differs"),
        "noFailures": Words("Nowhere does a test leave its band."),
        "certificate": Words("Document"),
        "makeCertificate": Words("Make the document"),
        "making": Words("The document is being made …"),
        "tests": Words("Tests of this machine"),
        "upwardsCircle": Words("counter-clockwise ↺"),
        "downwardsCircle": Words("clockwise ↻"),
        "modelUpCircle": Words("axes, effects ↺, U of the axes"),
        "modelDownCircle": Words("axes, effects ↻, U of the axes"),
        "modelUp": Words("axes ↑ with U"),
        "modelDown": Words("axes ↓ with U"),
        "resetCircle": Words("Whole circle"),
        "reset": Words("Whole line"),
        "targetCircle": Words("Angle"),
        "target": Words("Place"),
        "run": Words("Turn"),
        "directionCircle": Words("Sense"),
        "zoom": Words("Drag to look closer, with Shift to move; double-click for the whole."),
        "noiseFloorIs": Words(
            "Scatter, and irregular shape without a name: what is left once all that was found is in the "
            "model. No effect takes it away."
        ),
        "compensation": TABLES,
        "writeTable": Words("Write the tables"),
        "positiveValue": Words("A positive value moves an axis"),
        "plus": Words("in its positive direction"),
        "minus": Words("in its negative direction"),
        "notKnown": Words("not known: a trial value shows it"),
        "writeTrial": Words("Write a trial value"),
        "showForecast": Words("Show the forecast"),
        "asMeasured": Words("as measured"),
        "secondTest": Words("Circle run again with the tables"),
        "hold": Words("Hold it against the forecast"),
        "build": Words("Step by step"),
        "stairs": Words("The error falls, step by step"),
        "jobs": Words("Jobs of this folder"),
        "outside": Words(
            "The machine file was changed outside of this page; it shows the machine as it is now."
        ),
        "broken": Words(
            "The machine file cannot be read as it is. Mend it in the editor; this page goes on by itself."
        ),
    }
)


def collect_machine_texts(language: Language) -> dict[str, str]:
    """Return all words of the page of a machine in one language, and that it is one."""
    own = {name: words.in_language(language) for name, words in MACHINE_TEXTS.items()}
    return {**collect_texts(language), **own, "machine": "machine"}


def collect_texts(language: Language) -> dict[str, str]:
    """Return all of them in one language."""
    return {name: words.in_language(language) for name, words in TEXTS.items()}
