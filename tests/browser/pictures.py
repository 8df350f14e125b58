"""Pictures of pages for the documentation: made by the tests, when the environment asks for them."""

from __future__ import annotations

import io
import os
from pathlib import Path

from PIL import Image
from playwright.sync_api import Page

_PICTURES = Path(__file__).parents[2] / "docs" / "images"
_COLOURS = 256


def picture(page: Page, name: str) -> None:
    """Write a picture of a page if ``ZLMREPORT_PICTURES`` is set; demand that it is there in any case."""
    path = _PICTURES / f"workbench-{name}.png"
    if os.environ.get("ZLMREPORT_PICTURES"):
        page.mouse.move(0, 0)
        page.wait_for_load_state(
            "networkidle"
        )  # what comes later would make the page longer than its picture
        page.evaluate("scrollTo(0, 0)")  # what keeps in sight would lie over what was scrolled away
        content = page.screenshot(full_page=True)
        with Image.open(io.BytesIO(content)) as image:
            image.convert("RGB").quantize(_COLOURS).save(path, optimize=True)
    assert path.is_file()
