"""What the site of the documentation needs beside its pages; mkdocs.yml names this as its hook.

The order of the pages, the two faces for Python, files outside the documentation to which a page links, the
list of versions, and the proof that no page asks a stranger for anything.
"""

from __future__ import annotations

import json
import re
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import notebooks
from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File, Files

from zlmreport.version import __version__

_ROOT = Path(__file__).parents[2]
_FOLDERS = {
    "Tutorials": "tutorial",
    "How to": "how-to",
    "Explanation": "explanation",
    "Notebooks": "notebooks",
    "Reference": "reference",
}
_FACES = {
    "reference/python.md": ("zlmreport", "In Python"),
    "reference/plugin-door.md": ("zlmreport.plugin", "The door for plugins, name by name"),
}
#: A link that leaves the documentation: what stands before its target, and the target in the project.
_OUTWARD = re.compile(
    r"(\]\()((?:\.\./)+)((?:configs|plugins|src|tests)/[^)#]+|LICENSE|README\.md|CHANGELOG\.md)(?=\))"
)
#: A fence that names its file, as the pages write it: the site prints the name above the code.
_NAMED_FENCE = re.compile(r"^(```[a-z]+) ([^\s`]+)$", re.MULTILINE)
_NOTEBOOK = re.compile(r"(notebooks/\w+)\.py(\))")
_FETCHED = {"script": "src", "img": "src", "iframe": "src", "source": "src", "link": "href"}


def on_config(config: Any) -> Any:
    """Order the pages as a reader comes to them, and give each version a folder of its own."""
    docs = Path(config.docs_dir)
    found = {
        title: sorted(
            str(page.relative_to(docs).with_suffix(".md")) for page in (docs / folder).glob("*.[mp][dy]")
        )
        for title, folder in _FOLDERS.items()
    }
    found["Reference"] += _FACES
    config.nav = [
        "README.md",
        *({title: pages} for title, pages in found.items()),
        "architecture.md",
        "performance.md",
    ]
    config.site_dir = str(Path(config.site_dir) / __version__)
    return config


def on_files(files: Files, config: Any) -> Files:
    """Add the faces for Python, and every file outside the documentation to which a page links."""
    for page, (module, title) in _FACES.items():
        files.append(File.generated(config, page, content=f"# {title}\n\n::: {module}\n"))
    for notebook in sorted(Path(config.docs_dir).glob("notebooks/*.py")):
        name = f"notebooks/{notebook.stem}.md"
        files.remove(files.src_uris[f"notebooks/{notebook.name}"])
        files.append(File.generated(config, name, content=notebooks.page(notebook)))
    linked = {
        match[3] for page in files.documentation_pages() for match in _OUTWARD.finditer(page.content_string)
    }
    for target in sorted(linked):
        files.append(File.generated(config, f"files/{target}", abs_src_path=str(_ROOT / target)))
    return files


def on_page_markdown(markdown: str, page: Any, **_: Any) -> str:
    """Write the names of files as the site has them; lead what leaves the pages to copies."""
    up = "../" * page.file.src_uri.count("/")
    titled = _NAMED_FENCE.sub(r'\1 title="\2"', markdown)
    local = _OUTWARD.sub(lambda match: f"{match[1]}{up}files/{match[3]}", titled)
    return _NOTEBOOK.sub(r"\1.md\2", local)


def on_post_build(config: Any) -> None:
    """Refuse a page that fetches anything from elsewhere; list the versions that stand side by side."""
    site = Path(config.site_dir)
    strangers = [
        f"{page.relative_to(site)}: {address}"
        for page in sorted(site.rglob("*.html"))
        for address in _fetched_from_elsewhere(page)
    ]
    if strangers:
        raise PluginError("pages that fetch from elsewhere:\n" + "\n".join(strangers))
    versions = sorted((folder.name for folder in site.parent.iterdir() if folder.is_dir()), reverse=True)
    listed = [{"version": version, "title": version, "aliases": []} for version in versions]
    (site.parent / "versions.json").write_text(json.dumps(listed), encoding="utf-8")
    (site.parent / "index.html").write_text(
        f'<!doctype html><meta http-equiv="refresh" content="0; url={__version__}/"><title>zlmreport</title>',
        encoding="utf-8",
    )


def _fetched_from_elsewhere(page: Path) -> list[str]:
    fetched: list[str] = []

    class Addresses(HTMLParser):
        def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
            values = dict(attributes)
            if tag == "link" and values.get("rel") in {"canonical", "prev", "next"}:
                return
            address = values.get(_FETCHED.get(tag, "")) or ""
            if re.match(r"(https?:)?//", address):
                fetched.append(address)

    Addresses().feed(page.read_text(encoding="utf-8"))
    return fetched
