"""The door of formats that are made of HTML: the composed page."""

from __future__ import annotations

from zlmreport.document.typesetting.compose import (
    GRAPH_ADDRESS,
    LOGO_ADDRESS,
    Setting as HtmlSetting,
    compose_html,
)

__all__ = [
    "GRAPH_ADDRESS",
    "LOGO_ADDRESS",
    "HtmlSetting",
    "compose_html",
]
