"""The words of the page that do not depend on a job: headings, buttons, what a reading is described by."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from zlmreport.document.subjects.compensation import CONFIRMED
from zlmreport.document.subjects.diagnosis import CANDIDATES, VERDICT
from zlmreport.document.subjects.fit import EFFECTS
from zlmreport.document.subjects.forecast import FALL
from zlmreport.document.subjects.linked import GRAPH_TEXTS
from zlmreport.language import Language, Words
from zlmreport.model.compensation.confirmation import ConfirmationVerdict

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
        "verdict": VERDICT,
        "candidates": CANDIDATES,
        "otherEffect": Words(en="Add another effect", de="Anderen Einfluss hinzufügen"),
        "fall": FALL,
        "model": EFFECTS,
        "noEffects": Words(
            en="The model has no effect yet. Begin with offset.",
            de="Das Modell hat noch keinen Einfluss. Beginnen Sie mit der Nullpunktverschiebung.",
        ),
        "standards": Words(en="What the standards say", de="Was die Normen sagen"),
        "certificate": Words(en="Certificate", de="Kalibrierschein"),
        "makeCertificate": Words(en="Make the certificate", de="Kalibrierschein erstellen"),
        "making": Words(en="The certificate is being made …", de="Der Kalibrierschein entsteht …"),
        "formats": Words(en="Formats", de="Formate"),
        "lacking": Words(
            en="A calibration certificate must state these too; the job does not yet.",
            de="Ein Kalibrierschein muss auch dies angeben; der Auftrag tut es noch nicht.",
        ),
        "orNegligible": Words(en="or negligible because", de="oder vernachlässigbar, weil"),
        "atLaboratory": Words(en="at the laboratory", de="beim Laboratorium"),
        "atCustomer": Words(en="at the customer's", de="beim Auftraggeber"),
        "page": Words(en="Page {page} of {pages}", de="Seite {page} von {pages}"),
        "sheetPage": Words(en="Sheet: page {page} of {pages}", de="Blatt: Seite {page} von {pages}"),
        "pageBefore": Words(en="The page before", de="Die Seite davor"),
        "pageAfter": Words(en="The next page", de="Die nächste Seite"),
        "compensation": Words(en="Compensation table", de="Kompensationstabelle"),
        "whichTable": Words(
            en="Which table was active during this test? A new one on top of one that nobody knows corrects "
            "twice. Name its file as axis.compensation_table in the job, or:",
            de="Welche Tabelle war bei dieser Prüfung wirksam? Eine neue über einer unbekannten korrigiert "
            "doppelt. Nennen Sie ihre Datei im Auftrag als axis.compensation_table, oder:",
        ),
        "noTable": Words(en="None was active", de="Keine war wirksam"),
        "controller": Words(en="Control", de="Steuerung"),
        "untried": Words(en="{controller} (never tried on it)", de="{controller} (nie an ihr erprobt)"),
        "step": Words(en="Rows every", de="Zeilen alle"),
        "atTargets": Words(en="at targets", de="wie Messung"),
        "unconfirmed": Words(en="write it even if never tried", de="auch schreiben, wenn nie erprobt"),
        "writeTable": Words(en="Write the table", de="Tabelle schreiben"),
        "writing": Words(en="The table is being written …", de="Die Tabelle entsteht …"),
        "withTable": Words(en="With the table", de="Mit der Tabelle"),
        "betweenRows": Words(
            en="Between its {rows} rows up to {largest} are left, at {at}.",
            de="Zwischen ihren {rows} Zeilen bleiben bis zu {largest}, bei {at}.",
        ),
        "noMeasurement": Words(
            en="A forecast is no measurement: the axis with its table needs a test of its own.",
            de="Eine Vorhersage ist keine Messung: Die Achse mit ihrer Tabelle braucht eine eigene Prüfung.",
        ),
        "secondTest": Words(en="Second test", de="Zweite Prüfung"),
        "hold": Words(en="Hold it against the table", de="Gegen die Tabelle halten"),
        "holding": Words(en="The two tests are being compared …", de="Die Prüfungen werden verglichen …"),
        **{name: CONFIRMED[verdict] for verdict, name in _CONFIRMED.items()},
        "left": Words(en="E is {share} % of what it was.", de="E beträgt {share} % von vorher."),
        "tests": Words(en="Tests of this axis", de="Prüfungen dieser Achse"),
        "thisTest": Words(en="this page", de="diese Seite"),
        "difference": Words(en="Difference to this test", de="Unterschied zu dieser Prüfung"),
        "differenceIs": Words(
            en="Mean deviation of the other test less that of this one; straight between its targets.",
            de="Mittlere Abweichung der anderen Prüfung abzüglich der von dieser; gerade zwischen ihren "
            "Sollpositionen.",
        ),
        "overDays": Words(en="over the tests, with U", de="über die Prüfungen, mit U"),
        "models": Words(en="The models side by side", de="Die Modelle nebeneinander"),
        "excluded": Words(en="Readings set aside", de="Beiseite gelegte Messwerte"),
        "changes": Words(en="Steps so far", de="Bisherige Schritte"),
        "noChanges": Words(en="None on this page yet.", de="Auf dieser Seite noch keine."),
        "undo": Words(en="Undo", de="Zurücknehmen"),
        "redo": Words(en="Redo", de="Wiederholen"),
        "redoOf": Words(en="Redo: {step}", de="Wiederholen: {step}"),
        "ask": Words(
            en="Tell me this length, and I can test {effects} as well.",
            de="Nennen Sie mir diese Länge, und ich kann auch {effects} prüfen.",
        ),
        "state": Words(en="Save into the job", de="In den Auftrag schreiben"),
        "faults": Words(en="The data look wrong", de="Die Daten sehen falsch aus"),
        "remedy": Words(en="Remedy", de="Abhilfe"),
        "before": Words(en="before this step", de="vor diesem Schritt"),
        "after": Words(en="after this step: {step}", de="nach diesem Schritt: {step}"),
        "undoOf": Words(en="Undo: {step}", de="Zurücknehmen: {step}"),
        "add": Words(en="Add", de="Hinzufügen"),
        "addEffect": Words(en="Add {effect} to the model", de="{effect} zum Modell hinzufügen"),
        "remove": Words(en="Remove", de="Entfernen"),
        "removeEffect": Words(en="Remove {effect} from the model", de="{effect} aus dem Modell entfernen"),
        "fix": Words(en="Fix", de="Festhalten"),
        "fixParameter": Words(
            en="Fix {parameter} at this value", de="{parameter} auf diesem Wert festhalten"
        ),
        "free": Words(en="Free", de="Freigeben"),
        "freeParameter": Words(
            en="Estimate {parameter} from the readings", de="{parameter} aus den Messwerten schätzen"
        ),
        "given": Words(en="given", de="vorgegeben"),
        "atBound": Words(en="held at bound", de="an der Grenze"),
        "probability": Words(en="Probability", de="Wahrscheinlichkeit"),
        "errorAfter": Words(en="Error after it", de="Abweichung danach"),
        "alike": Words(
            en="These readings cannot tell them apart.",
            de="Diese Messwerte können sie nicht unterscheiden.",
        ),
        "equals": Words(en="Not to be told from", de="Nicht zu unterscheiden von"),
        "tell": Words(en="What would tell them apart", de="Was sie unterscheiden würde"),
        "experiment": Words(en="The next experiment", de="Der nächste Versuch"),
        "writeJob": Words(en="Write its job", de="Seinen Auftrag schreiben"),
        "simulating": Words(en="Plans are being simulated …", de="Pläne werden simuliert …"),
        "diagnosing": Words(
            en="Every installed effect is being tried …", de="Jeder installierte Einfluss wird geprüft …"
        ),
        "stop": Words(en="Stop", de="Anhalten"),
        "stopped": Words(en="The diagnosis was stopped.", de="Die Diagnose wurde angehalten."),
        "diagnose": Words(en="Diagnose", de="Diagnose beginnen"),
        "seconds": Words(en="{seconds} s", de="{seconds} s"),
        "underWay": Words(en="{share} %, {seconds} s", de="{share} %, {seconds} s"),
        "working": Words(en="Working …", de="Einen Moment …"),
        "setAside": Words(en="Set this reading aside", de="Diesen Messwert beiseite legen"),
        "setAllAside": Words(en="Set these readings aside", de="Diese Messwerte beiseite legen"),
        "reason": Words(
            en="Reason, as the certificate will state it", de="Grund, wie ihn der Kalibrierschein nennt"
        ),
        "bringBack": Words(en="Bring back", de="Zurückholen"),
        "effect": Words(en="Effect", de="Einfluss"),
        "error": Words(en="Error", de="Abweichung"),
        "noiseFloor": Words(en="Noise floor", de="Grundrauschen"),
        "withoutModel": Words(en="without model", de="ohne Modell"),
        "leftOut": Words(en="Runs left out", de="Durchläufe ausgelassen"),
        "leftOutIs": Words(
            en="Each run in turn is predicted by a model that was fitted to the other runs: root mean square"
            " of what is wrong with these predictions. If it is much larger than the error, the model "
            "follows noise.",
            de="Jeder Durchlauf wird einmal von einem Modell vorhergesagt, das an die übrigen angepasst ist: "
            "quadratischer Mittelwert der Fehler dieser Vorhersagen. Ist er viel größer als die Abweichung, "
            "folgt das Modell dem Rauschen.",
        ),
        "errorIs": Words(
            en="Root mean square of the residuals: what the model does not explain.",
            de="Quadratischer Mittelwert der Residuen: was das Modell nicht erklärt.",
        ),
        "noiseFloorIs": Words(
            en="The scatter of readings repeated at one target in one direction: no model gets below it, and"
            " a good one nearly down to it.",
            de="Die Streuung wiederholter Messwerte an einer Sollposition in einer Richtung: Kein Modell "
            "kommt darunter, ein gutes bis nahe daran.",
        ),
        "pIs": Words(
            en="The chance that noise alone would look so. The smaller, the surer it is no accident.",
            de="Die Wahrscheinlichkeit, dass Rauschen allein so aussähe. Je kleiner, desto sicherer ist es "
            "kein Zufall.",
        ),
        "uIs": Words(
            en="Expanded uncertainty of the value, as the certificate states it.",
            de="Erweiterte Messunsicherheit des Werts, wie der Kalibrierschein sie angibt.",
        ),
        "jobs": Words(en="Jobs of this folder", de="Aufträge dieses Ordners"),
        "earlier": Words(en="Earlier tests of these axes", de="Frühere Prüfungen dieser Achsen"),
        "allJobs": Words(en="All jobs", de="Alle Aufträge"),
        "job": Words(en="Job", de="Auftrag"),
        "axis": Words(en="Axis", de="Achse"),
        "measuredOn": Words(en="Measured", de="Gemessen"),
        "dueOn": Words(en="Due", de="Fällig"),
        "jobState": Words(en="State", de="Stand"),
        "oneWave": Words(en="One wave", de="Eine Welle"),
        "build": Words(en="Build the model", de="Modell aufbauen"),
        "building": Words(
            en="Diagnosis after diagnosis; nothing is written …",
            de="Diagnose um Diagnose; geschrieben wird nichts …",
        ),
        "stairs": Words(en="Step by step", de="Schritt für Schritt"),
        "stairsAre": Words(
            en="A step is written when you take it. Stop at any; each can be taken back.",
            de="Ein Schritt wird geschrieben, wenn Sie ihn gehen. Halten Sie an, wo Sie wollen; jeder lässt "
            "sich zurücknehmen.",
        ),
        "noStairs": Words(
            en="There is no step with evidence of its own.",
            de="Es gibt keinen Schritt, für den etwas spricht.",
        ),
        "takeStep": Words(en="Take this step", de="Diesen Schritt gehen"),
        "upToHere": Words(en="Up to here", de="Bis hierher"),
        "stepBack": Words(en="One step back", de="Einen Schritt zurück"),
        "lookAtPages": Words(en="Look at the pages", de="Seiten ansehen"),
        "parameter": Words(en="Parameter", de="Kenngröße"),
        "now": Words(en="Now", de="Jetzt"),
        "limit": Words(en="Limit", de="Grenzwert"),
        "byTable": Words(en="Compensated by a table", de="Mit Positionstabelle kompensiert"),
        "byModel": Words(en="By the whole model", de="Mit dem ganzen Modell"),
        "forecast": Words(
            en="The last two columns are forecasts: the readings of this test less what the model explains.",
            de="Die letzten beiden Spalten sind Vorhersagen: die Messwerte dieser Prüfung abzüglich dessen, "
            "was das Modell erklärt.",
        ),
        "outside": Words(
            en="The job was changed outside of this page; it shows the job as it is now.",
            de="Der Auftrag wurde außerhalb dieser Seite geändert; sie zeigt ihn, wie er jetzt ist.",
        ),
        "broken": Words(
            en="The job cannot be read as it is. Mend it in the editor; this page goes on by itself.",
            de="Der Auftrag ist so nicht lesbar. Berichtigen Sie ihn im Editor; die Seite fährt von selbst "
            "fort.",
        ),
        "gone": Words(
            en="zlmreport no longer answers. Start it again on the terminal: zlmreport workbench.",
            de="zlmreport antwortet nicht mehr. Starten Sie es im Terminal neu: zlmreport workbench.",
        ),
        "close": Words(en="Close", de="Schließen"),
        "hidden": Words(en="What this test cannot see", de="Was diese Messung nicht sieht"),
        "notExcluded": Words(
            en="Not excluded, for they could not be tried", de="Nicht auszuschließen, da nicht prüfbar"
        ),
        "remarks": Words(en="Taken for granted", de="Angenommen"),
        "outOfDate": Words(
            en="Made before the last step: make it again.",
            de="Vor dem letzten Schritt erstellt: neu erstellen.",
        ),
        "back": Words(en="Back to the workbench", de="Zurück zur Werkbank"),
        "equation": Words(en="Equation", de="Gleichung"),
        "look": Words(en="Its look in the residuals", de="Sein Bild in den Residuen"),
        "parameters": Words(en="Parameters", de="Parameter"),
        "range": Words(en="Plausible", de="Plausibel"),
        "rangesFrom": Words(en="Plausible ranges: {source}.", de="Plausible Bereiche: {source}."),
        "estimated": Words(en="In this model", de="In diesem Modell"),
        "keys": Words(en="Keys in a job", de="Schlüssel im Auftrag"),
        "confusions": Words(en="What it is taken for", de="Womit er verwechselt wird"),
        "contains": Words(
            en="It contains {effects}, which cannot stand beside it in a model.",
            de="Er enthält {effects}; daneben kann das nicht im Modell stehen.",
        ),
        "language": Words(en="Deutsch", de="English"),
        "implausible": Words(en="implausible", de="unplausibel"),
        "doubtful": Words(en="doubtful", de="zweifelhaft"),
        "expected": Words(en="expected {value}", de="erwartet {value}"),
    }
)

#: What the page of a machine says otherwise, or besides.
MACHINE_TEXTS: Mapping[str, Words] = MappingProxyType(
    {
        "measured": Words(en="Measured against axes and effects", de="Messung gegen Achsen und Einflüsse"),
        "model": Words(en="Effects of drives and structure", de="Einflüsse von Antrieben und Struktur"),
        "noEffects": Words(
            en="The model has no effect yet. Begin with centre-offset and radius.",
            de="Das Modell hat noch keinen Einfluss. Beginnen Sie mit Ort und Länge des Stabs.",
        ),
        "failures": Words(en="Where it differs", de="Wo es abweicht"),
        "noFailures": Words(
            en="Nowhere does a test leave its band.", de="Nirgends verlässt eine Prüfung ihr Band."
        ),
        "certificate": Words(en="Document", de="Dokument"),
        "makeCertificate": Words(en="Make the document", de="Dokument erstellen"),
        "making": Words(en="The document is being made …", de="Das Dokument entsteht …"),
        "tests": Words(en="Tests of this machine", de="Prüfungen dieser Maschine"),
        "upwardsCircle": Words(en="counter-clockwise ↺", de="gegen den Uhrzeigersinn ↺"),
        "downwardsCircle": Words(en="clockwise ↻", de="im Uhrzeigersinn ↻"),
        "modelUpCircle": Words(en="axes, effects ↺, U of the axes", de="Achsen, Einflüsse ↺, U der Achsen"),
        "modelDownCircle": Words(en="axes, effects ↻, U of the axes", de="Achsen, Einflüsse ↻, U der Achsen"),
        "modelUp": Words(en="axes ↑ with U", de="Achsen ↑ mit U"),
        "modelDown": Words(en="axes ↓ with U", de="Achsen ↓ mit U"),
        "resetCircle": Words(en="Whole circle", de="Ganzer Kreis"),
        "reset": Words(en="Whole line", de="Ganze Linie"),
        "targetCircle": Words(en="Angle", de="Winkel"),
        "target": Words(en="Place", de="Ort"),
        "run": Words(en="Turn", de="Umlauf"),
        "directionCircle": Words(en="Sense", de="Drehsinn"),
        "zoom": Words(
            en="Drag to look closer, with Shift to move; double-click for the whole.",
            de="Ziehen vergrößert, mit Umschalt verschiebt es; Doppelklick zeigt wieder alles.",
        ),
        "noiseFloorIs": Words(
            en="Scatter, and irregular shape without a name: what is left once all that was found is in the "
            "model. No effect takes it away.",
            de="Streuung und unregelmäßige Form ohne Namen: was bleibt, wenn alles Gefundene im Modell "
            "steht. Kein Einfluss nimmt es weg.",
        ),
        "errorIs": Words(
            en="Root mean square of all circles together, without where the bar stands and how long it is.",
            de="Quadratischer Mittelwert aller Kreise zusammen, ohne Ort und Länge des Stabs.",
        ),
        "build": Words(en="Step by step", de="Schritt für Schritt"),
        "stairs": Words(en="The error falls, step by step", de="Der Fehler fällt, Schritt für Schritt"),
        "jobs": Words(en="Jobs of this folder", de="Aufträge dieses Ordners"),
        "outside": Words(
            en="The machine file was changed outside of this page; it shows the machine as it is now.",
            de="Die Maschinendatei wurde außerhalb dieser Seite geändert; sie zeigt die Maschine, wie sie "
            "jetzt ist.",
        ),
        "broken": Words(
            en="The machine file cannot be read as it is. Mend it in the editor; this page goes on by "
            "itself.",
            de="Die Maschinendatei ist so nicht lesbar. Berichtigen Sie sie im Editor; die Seite fährt von "
            "selbst fort.",
        ),
    }
)


def machine_texts(language: Language) -> dict[str, str]:
    """Return all words of the page of a machine in one language, and that it is one."""
    own = {name: words.in_language(language) for name, words in MACHINE_TEXTS.items()}
    return {**texts(language), **own, "machine": "machine"}


def texts(language: Language) -> dict[str, str]:
    """Return all of them in one language."""
    return {name: words.in_language(language) for name, words in TEXTS.items()}
