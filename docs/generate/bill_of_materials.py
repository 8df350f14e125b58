"""The bill of materials in the wheel (CycloneDX 1.7, PEP 770): what runs the project, under which licence.

A wheel fixes no versions of what it needs, so ranges are stated.
"""

from __future__ import annotations

import json
import re
import tomllib
from pathlib import Path

from packaging.requirements import Requirement

from zlmreport.version import __version__

_ROOT = Path(__file__).parents[2]


def text() -> str:
    """Return the bill of materials as JSON, with the licences of the page that is tested."""
    project = tomllib.loads((_ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    page = (_ROOT / "docs/reference/licences.md").read_text(encoding="utf-8")
    licences = dict(re.findall(r"^\| ([a-z0-9-]+) \| ([^|]+) \|", page, re.MULTILINE))
    needed = [Requirement(each) for each in project["dependencies"]]
    root = f"pkg:pypi/zlmreport@{__version__}"
    bill = {
        "$schema": "http://cyclonedx.org/schema/bom-1.7.schema.json",
        "bomFormat": "CycloneDX",
        "specVersion": "1.7",
        "version": 1,
        "metadata": {
            "component": {
                "type": "application",
                "bom-ref": root,
                "name": project["name"],
                "version": __version__,
                "licenses": [{"license": {"id": project["license"]}}],
                "purl": root,
            }
        },
        "components": [
            {
                "type": "library",
                "bom-ref": f"pkg:pypi/{each.name}",
                "name": each.name,
                "versionRange": _range(each),
                "isExternal": True,
                "licenses": [{"license": _licence(licences[each.name])}],
                "purl": f"pkg:pypi/{each.name}",
            }
            for each in needed
        ],
        "dependencies": [{"ref": root, "dependsOn": [f"pkg:pypi/{each.name}" for each in needed]}],
    }
    return json.dumps(bill, indent=2) + "\n"


def _range(requirement: Requirement) -> str:
    """Return the versions that a requirement admits, as ``vers`` writes them: it knows no ``70.*``."""
    bounds = ",".join(str(each) for each in sorted(requirement.specifier, key=str))
    bounds = re.sub(r"==(\d+)\.\*", lambda major: f">={major[1]},<{int(major[1]) + 1}", bounds)
    return "vers:pypi/" + bounds.replace(",", "|")


def _licence(words: str) -> dict[str, str]:
    """Return a licence by its identifier of SPDX, or in the words of the page where one does not say it."""
    return {"name" if " " in words else "id": words}
