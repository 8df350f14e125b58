"""The plugins that come with zlmreport; they are found by entry point, like anybody else's.

What each offers is declared here, so that a job loads only those it names.
"""

from __future__ import annotations

from collections.abc import Mapping

#: Entry point to kinds to identifiers.
OFFERS: Mapping[str, Mapping[str, tuple[str, ...]]] = {
    "dcc": {"renderer": ("dcc",), "source": ("dcc",)},
    "ecmc": {"source": ("ecmc",)},
    "effects": {
        "effect": (
            "abbe",
            "air-index",
            "backlash",
            "backlash-bow",
            "backlash-gradient",
            "compensation-shift",
            "compensation-sign",
            "cosine-error",
            "datum-step",
            "datum-temperature",
            "dead-path",
            "directional-pitch",
            "eccentricity",
            "ellipticity",
            "encoder-interpolation",
            "first-run",
            "gear-mesh",
            "offset",
            "periodic",
            "polynomial",
            "reversal-relaxation",
            "scale-error",
            "scale-expansion",
            "scale-joint",
            "scale-kink",
            "screw-expansion",
            "screw-pitch",
            "thermal-drift",
            "thermal-growth",
            "time-periodic",
        )
    },
    "html": {"renderer": ("html",)},
    "ids3010": {"instrument": ("ids3010",)},
    "iso230_2": {
        "standard": (
            "iso230-2:1988",
            "iso230-2:1997",
            "iso230-2:2006",
            "iso230-2:2014",
        )
    },
    "json_results": {"renderer": ("csv", "json", "xlsx")},
    "laser_csv": {"source": ("laser-csv",)},
    "nd28x": {"instrument": ("nd28x",)},
    "nmtba": {"standard": ("nmtba",)},
    "notifiers": {
        "notifier": (
            "apprise",
            "mail",
        )
    },
    "part_programs": {"part_program": ("fanuc", "heidenhain", "linuxcnc", "siemens-840d")},
    "pdf": {"renderer": ("pdf",)},
    "pdf_typst": {"renderer": ("pdf-typst",)},
    "renishaw_rtl": {"source": ("renishaw-rtl",)},
    "serial_interferometer": {"source": ("serial-interferometer",)},
    "text_readout": {"instrument": ("text-readout",)},
    "umd": {
        "instrument": (
            "umd0",
            "umd1",
            "umd2",
        )
    },
    "vdi": {
        "standard": (
            "vdi-dgq-3441",
            "vdi-vde-2617",
        )
    },
    "controller_csv": {"controller": ("csv",)},
    "controllers_on_paper": {
        "controller": (
            "beckhoff",
            "etalon",
            "fanuc",
            "heidenhain",
            "isg",
            "mitsubishi",
            "siemens-840d",
            "siemens-840d-cec",
        )
    },
    "controller_linuxcnc": {"controller": ("linuxcnc",)},
}
