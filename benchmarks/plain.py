"""The plain recipe: a certificate made the way most people would make one.

matplotlib.pyplot with the constrained layout draws each graph into an SVG, a Jinja template makes a page
of HTML, and WeasyPrint prints it; everything is made anew for every certificate, as in a script. It knows
nothing of zlmreport: it takes the content of a certificate (see ``content.py``) and is a program of its own.
"""

from __future__ import annotations

import base64
import io
import json
import sys
from pathlib import Path
from typing import Any

import matplotlib as mpl
import matplotlib.pyplot as plt
from jinja2 import Environment, FileSystemLoader
from matplotlib import font_manager
from matplotlib.axes import Axes
from weasyprint import CSS, HTML
from weasyprint.text.fonts import FontConfiguration

HERE = Path(__file__).parent
FONTS = HERE.parent / "report_templates" / "zlmreport_templates" / "fonts"

#: Colour, line and mark of each role.
STYLES: dict[str, dict[str, Any]] = {
    "MEAN_POSITIVE": {"color": "#0072b2", "marker": "^"},
    "MEAN_NEGATIVE": {"color": "#d55e00", "marker": "v", "linestyle": "--"},
    "MEAN_BIDIRECTIONAL": {"color": "black", "marker": "o", "linestyle": "-."},
    "LIMIT_POSITIVE": {"color": "#0072b2", "linewidth": 0.7, "linestyle": "--"},
    "LIMIT_NEGATIVE": {"color": "#d55e00", "linewidth": 0.7, "linestyle": ":"},
    "SPREAD": {"color": "#00735c", "linewidth": 0.7},
    "REVERSAL": {"color": "#944273", "linewidth": 0.7, "linestyle": "-."},
    "BAND_LIMIT": {"color": "black", "linewidth": 0.8, "linestyle": "--"},
    "TOLERANCE": {"color": "black", "linewidth": 0.9, "linestyle": "-."},
}
READINGS: dict[str, dict[str, Any]] = {
    "POSITIVE": {"color": "#5999c2", "marker": "^"},
    "NEGATIVE": {"color": "#e08f57", "marker": "v"},
}

for file in FONTS.glob("*.ttf"):
    font_manager.fontManager.addfont(file)
mpl.rcParams.update(
    {
        "font.family": "IBM Plex Sans",
        "font.size": 8,
        "lines.linewidth": 1.1,
        "lines.markersize": 3.5,
        "axes.linewidth": 0.6,
        "grid.linewidth": 0.4,
        "grid.color": "0.9",
    }
)


def certificate(content: dict[str, Any]) -> bytes:
    """Return the PDF of a certificate."""
    environment = Environment(loader=FileSystemLoader(HERE), autoescape=True, trim_blocks=True)
    environment.filters["graph"] = graph
    html = environment.get_template("plain.html").render(content)
    fonts = FontConfiguration()
    css = CSS(HERE / "plain.css", font_config=fonts)
    pdf = HTML(string=html).write_pdf(stylesheets=[css], font_config=fonts)
    assert pdf is not None
    return bytes(pdf)


def graph(figure: dict[str, Any]) -> str:
    """Return a graph as the address of an image."""
    panels = figure["panels"]
    fig, all_axes = plt.subplots(
        len(panels), figsize=(6.7, 3.6), sharex=True, squeeze=False, layout="constrained"
    )
    for axes, panel in zip(all_axes[:, 0], panels, strict=True):
        draw(axes, panel)
        axes.set_ylabel(figure["y_title"])
    axes.set_xlabel(figure["x_title"])
    handles, labels = all_axes[0, 0].get_legend_handles_labels()
    fig.legend(handles, labels, loc="outside lower center", ncols=6, frameon=False)
    file = io.BytesIO()
    fig.savefig(file, format="svg")
    plt.close(fig)
    return "data:image/svg+xml;base64," + base64.b64encode(file.getvalue()).decode()


def draw(axes: Axes, panel: dict[str, Any]) -> None:
    """Draw what a panel shows."""
    for readings in panel["readings"]:
        axes.plot(
            readings["x"],
            readings["y"],
            **READINGS[readings["approach"]],
            linestyle="none",
            markerfacecolor="none",
            markeredgewidth=0.5,
        )
    for band in panel["bands"]:
        style = STYLES[band["role"]]
        axes.fill_between(
            band["x"], band["lower"], band["upper"], color=style["color"], alpha=0.12, linewidth=0
        )
        axes.plot(band["x"], band["lower"], label=band["label"], **style)
        axes.plot(band["x"], band["upper"], **style)
    for curve in panel["curves"]:
        axes.plot(curve["x"], curve["y"], label=curve["label"], **STYLES[curve["role"]])
    for level in panel["levels"]:
        axes.axhline(level["y"], label=level["label"], **STYLES[level["role"]])
    for arrow in panel["arrows"]:
        double_arrow(axes, arrow["x"], arrow)
    at_right = axes.get_yaxis_transform()
    right = axes.get_xlim()[1]
    for place, bracket in enumerate(panel["brackets"]):
        x = 1.04 + 0.06 * place
        double_arrow(axes, x, bracket, transform=at_right)
        axes.hlines([bracket["low"]], bracket["low_at"], right, color="0.35", linewidth=0.35)
        axes.hlines([bracket["high"]], bracket["high_at"], right, color="0.35", linewidth=0.35)
    if panel["heading"]:
        axes.set_title(panel["heading"])
    axes.grid(visible=True)


def double_arrow(axes: Axes, x: float, span: dict[str, Any], transform: Any = "data") -> None:
    """Draw an arrow with two heads, and its symbol beside it."""
    ends = {"arrowstyle": "<->", "linewidth": 0.55, "shrinkA": 0, "shrinkB": 0}
    axes.annotate(
        "", (x, span["low"]), (x, span["high"]), xycoords=transform, textcoords=transform, arrowprops=ends
    )
    axes.annotate(
        span["label"],
        (x, (span["low"] + span["high"]) / 2),
        (3, 0),
        xycoords=transform,
        textcoords="offset points",
        annotation_clip=False,
        verticalalignment="center",
    )


if __name__ == "__main__":
    Path(sys.argv[2]).write_bytes(certificate(json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))))
