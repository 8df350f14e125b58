"""What the linked graphs say, on the workbench's page and in a certificate."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from zlmreport.language import Words

GRAPH_TEXTS: Mapping[str, Words] = MappingProxyType(
    {
        "measured": Words(en="Measured against the model", de="Messung gegen Modell"),
        "residuals": Words(en="Residuals", de="Residuen"),
        "over": Words(en="over", de="über"),
        "failures": Words(en="Where the model fails", de="Wo das Modell versagt"),
        "noFailures": Words(
            en="No test of the residuals fails.", de="Keine Prüfung der Residuen schlägt an."
        ),
        "show": Words(en="Show the readings", de="Messwerte zeigen"),
        "reset": Words(en="Whole axis", de="Ganze Achse"),
        "point": Words(
            en="Point at a reading, or go from one to the next with the arrow keys.",
            de="Zeigen Sie auf einen Messwert, oder gehen Sie mit den Pfeiltasten von einem zum nächsten.",
        ),
        "target": Words(en="Target", de="Sollposition"),
        "run": Words(en="Run", de="Durchlauf"),
        "deviation": Words(en="Deviation", de="Abweichung"),
        "modelValue": Words(en="Model", de="Modell"),
        "residual": Words(en="Residual", de="Residuum"),
        "flagged": Words(en="stands off; not fitted", de="steht ab; nicht angepasst"),
        "upwards": Words(en="upwards ↑", de="aufwärts ↑"),
        "downwards": Words(en="downwards ↓", de="abwärts ↓"),
        "modelUp": Words(en="model ↑ with U", de="Modell ↑ mit U"),
        "modelDown": Words(en="model ↓ with U", de="Modell ↓ mit U"),
        "noise": Words(en="± 2σ of single readings", de="± 2σ einzelner Messwerte"),
        "zoom": Words(
            en="Drag to look closer; double-click for the whole axis.",
            de="Ziehen vergrößert; Doppelklick zeigt wieder die ganze Achse.",
        ),
    }
)
