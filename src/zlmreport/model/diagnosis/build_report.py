"""``zlmreport model build --json``: the steps of a build as values."""

from __future__ import annotations

from typing import Any

from zlmreport.language import Language
from zlmreport.model.diagnosis.building import Built
from zlmreport.model.diagnosis.report import report_error, report_model, report_remainder

SCHEMA = "zlmreport/build/1"


def build_values(built: Built) -> dict[str, Any]:
    """Return a build as plain values for a JSON file."""
    last, exchange = built.last, built.exchange
    axis = last.fit.design.axis
    return {
        "schema": SCHEMA,
        "steps": [
            {
                "effect": each.identifier,
                "settings": each.effect.settings.model_dump(mode="json"),
                **({"removed": True} if each.is_removed else {}),
                **({"indistinguishable_from": list(each.equals)} if each.equals else {}),
                "rms_before": axis.deviation_unit.from_si(each.before.rms),
                "rms_after": axis.deviation_unit.from_si(each.after.rms),
                "noise_rms": report_error(each.after, axis)["noise_rms"],
            }
            for each in built.steps
        ],
        "exchange": exchange and {"in": list(exchange.coming), "out": list(exchange.going)},
        "doubts": [
            {"effects": list(each.names), "probability": each.probability, "added": each.is_named}
            for each in built.doubts
        ],
        "questions": [each.in_language(Language.ENGLISH) for each in built.questions],
        "needless": list(built.needless),
        "verdict": last.verdict.value,
        "remainder": report_remainder(last.remainder, last.fit.design),
        "model": report_model(last.fit),
        "error": report_error(last.error, axis),
    }
