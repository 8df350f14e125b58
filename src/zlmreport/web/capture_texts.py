"""The words of the page of a capture."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from zlmreport.language import Words

CAPTURE_TEXTS: Mapping[str, Words] = MappingProxyType(
    {
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
    }
)
