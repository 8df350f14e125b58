"""The words of the page of a capture."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from zlmreport.language import Words

CAPTURE_TEXTS: Mapping[str, Words] = MappingProxyType(
    {
        "capture": Words(en="Capture", de="Messung"),
        "captureOf": Words(
            en="Readings are taken along the plan, into {journal}.",
            de="Messwerte werden nach dem Plan aufgenommen, in {journal}.",
        ),
        "captureBegin": Words(en="Begin", de="Beginnen"),
        "captureGoOn": Words(en="Go on", de="Weitermachen"),
        "captureStop": Words(en="Interrupt", de="Unterbrechen"),
        "captureClose": Words(en="Close it as it is", de="So abschließen"),
        "captureCloseHelp": Words(
            en="What was not taken is missing.", de="Was nicht aufgenommen wurde, fehlt."
        ),
        "captureSkip": Words(en="Skip visit {number}", de="Messpunkt {number} auslassen"),
        "captureBack": Words(en="Take the last one again", de="Den letzten noch einmal"),
        "captureRetake": Words(en="Again", de="Noch einmal"),
        "captureRetakeOf": Words(
            en="Take visit {number} again", de="Messpunkt {number} noch einmal aufnehmen"
        ),
        "captureRunAgain": Words(en="Run {run} again", de="Durchlauf {run} noch einmal"),
        "captureComment": Words(en="Comment", de="Bemerkung"),
        "captureNote": Words(en="Note it", de="Notieren"),
        "captureDone": Words(en="Done, go on", de="Erledigt, weiter"),
        "captureWaits": Words(en="Waiting for the instrument …", de="Warten auf das Messgerät …"),
        "captureNoDatum": Words(en="Waiting for the datum", de="Warten auf den Bezug"),
        "captureToGo": Words(en="{way} to go", de="noch {way}"),
        "captureRange": Words(en="range {range}", de="Spannweite {range}"),
        "captureStill": Words(en="Standstill", de="Stillstand"),
        "captureTaken": Words(en="{taken} of {planned} taken", de="{taken} von {planned} aufgenommen"),
        "captureMinutes": Words(en="about {minutes} min to go", de="noch etwa {minutes} min"),
        "captureOver": Words(
            en="All visits are taken. The certificate can be made.",
            de="Alle Messpunkte sind aufgenommen. Der Kalibrierschein kann entstehen.",
        ),
        "captureOpen": Words(en="To the results", de="Zu den Ergebnissen"),
        "captureVisit": Words(en="Visit", de="Messpunkt"),
        "captureRun": Words(en="Run", de="Durchlauf"),
        "captureTarget": Words(en="Target", de="Sollposition"),
        "captureDeviation": Words(en="Deviation", de="Abweichung"),
        "captureSpread": Words(en="Range", de="Spannweite"),
        "captureState": Words(en="State", de="Stand"),
        "captureIs.taken": Words(en="taken", de="aufgenommen"),
        "captureIs.next": Words(en="next", de="der nächste"),
        "captureIs.open": Words(en="to come", de="steht aus"),
        "captureIs.skipped": Words(en="left out", de="ausgelassen"),
        "captureIs.missed": Words(en="missing", de="fehlt"),
        "captureEvents": Words(en="What happened", de="Was geschah"),
    }
)
