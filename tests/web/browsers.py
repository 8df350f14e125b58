"""Browsers before the pages of a workbench."""

from __future__ import annotations

import warnings

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # it asks for a successor of httpx that is not packaged everywhere
    from starlette.testclient import TestClient

from zlmreport.web.answers import PageAnswers
from zlmreport.web.folder import FolderWorkbench
from zlmreport.web.guard import Door

DOOR = Door.at(8420)
_ROOT = f"http://127.0.0.1:{DOOR.port}"


def pass_by(workbench: PageAnswers | FolderWorkbench) -> TestClient:
    """Return a browser that has not been given the token."""
    return TestClient(workbench.make_app(DOOR), base_url=_ROOT, follow_redirects=False)


def enter(workbench: PageAnswers | FolderWorkbench) -> TestClient:
    """Return a browser that came by the address on the terminal."""
    browser = pass_by(workbench)
    assert browser.get(DOOR.address).status_code == 303
    browser.headers["Origin"] = _ROOT
    return browser
