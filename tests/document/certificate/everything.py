"""A job that states everything there is to state, for tests of what becomes of it on the page."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from document.certificate.documents import COMPLETE

SOURCE = COMPLETE["measurement"]["source"]
TAKEN = {
    "date": "2022-04-06",
    "end": "2022-04-07",
    "method": "linear",
    "feed": 2000,
    "dwell": 5,
    "warm_up": "1 h",
    "compensation": "active",
    "line": "Z 200",
    "error": "EYY",
    "at": {"X": 150, "Z": 200, "tool": [0, 0, 120]},
    "symbols": "vdi-vde-2617-3",
    "plane": {"axis": "Z", "at": 200},
    "deviations_from_method": "none",
    "excluded": [{"target": 5, "direction": "-", "run": 2, "reason": "Air hose touched the reflector."}],
    "operator": "B. Other",
    "remarks": "none",
    "source": SOURCE,
}
CONDITIONS = {
    "air_temperature": 20.5,
    "material_temperature": 20.5,
    "axis_temperature": 20.5,
    "air_pressure": 1013,
    "relative_humidity": 45,
    "expansion_coefficient": 11.5,
    "remarks": "none",
    "sensors": "air beside the beam",
    "thermometers": [
        {"name": "Pt100, no. 3", "certificate": "T 17", "calibrated": "2022-02-01", "due": "2023-02-01"}
    ],
}
EVERYTHING: Mapping[str, Any] = {
    **COMPLETE,
    "location": {"kind": "customer", "address": "Hall 3"},
    "dates": {"received": "2022-04-05", "sampled": "2022-04-04"},
    "sampling": "One axis of three.",
    "machine": {**COMPLETE["machine"], "kind": "machine tool", "location": "Hall 3", "condition": "used"},
    "axis": {
        "name": "Y",
        "kind": "linear",
        "travel": [-20, 20],
        "screw_pitch": 5,
        "signal_period": 0.02,
        "scale_element": 20,
        "pole_pitch": 24,
        "compensation_table": "table.csv",
        "angular_errors": "angles.csv",
        "abbe_offset": 100,
    },
    "measurement": TAKEN,
    "as_found": {
        "measurement": {**TAKEN, "end": "2022-04-06"},
        "work": "repair",
        "adjustment": "New nut.",
        "environment": CONDITIONS,
    },
    "instrument": {
        **COMPLETE["instrument"],
        "manufacturer": "Maker",
        "serial": "1",
        "calibrated": "2022-01-01",
        "expanded_uncertainty_per_metre": 0.5,
        "expansion_coefficient": 8,
        "compensation": "none",
    },
    "environment": CONDITIONS,
    "evaluate": [{**COMPLETE["evaluate"][0], "specification": "Order 4711"}],
    "uncertainty": {**COMPLETE["uncertainty"], "resolution": 0.01},
    "corrections": {"material": {"expansion_coefficient": 11.5}},
    "procedure": "QP 17, issue 4",
    "provided_by_customer": ["machine.serial", "environment.expansion_coefficient", "evaluate.tolerances"],
    "external": [
        {
            "results": "Air temperature",
            "provider": "Thermometry Ltd",
            "reference": "Report 8",
            "keys": ["environment.air_temperature"],
        },
        {"results": "Air pressure", "provider": "Weather Service"},
    ],
    "opinions": [
        {"statement": "There is play in the nut.", "basis": "The reversal value is alike everywhere."}
    ],
    "next_due": {"date": "2023-04-07", "agreed": True},
    "agreement": {"simplified": True, "reference": "Order 4711"},
}


def write_tables(folder: Path) -> None:
    """Write the tables of the axis that the job names."""
    (folder / "table.csv").write_text("position,deviation\n-20,0\n20,1\n")
    (folder / "angles.csv").write_text("position,angle\n-20,0\n20,1\n")
