"""All that a document may load while it becomes a PDF: what it is handed, and nothing from outside."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

from weasyprint.urls import URLFetcher, URLFetcherResponse

#: What there is to load: by address, bytes and media type.
Contents: TypeAlias = dict[str, tuple[bytes, str]]


class Supply(URLFetcher):  # type: ignore[misc]
    """Answers addresses from memory and refuses every other one, be it a file or a network address.

    Parameters
    ----------
    contents
        What there is.
    """

    def __init__(self, contents: Contents) -> None:
        # The base class's own set-up is left out: it installs the openers of files and networks.
        self._contents = contents
        self._fail_on_errors = False

    def fetch(self, url: str, headers: Mapping[str, str] | None = None) -> URLFetcherResponse:
        """Return what lies at an address; WeasyPrint reports an error and goes on without it otherwise."""
        del headers
        if url not in self._contents:
            raise ValueError(f"a certificate loads nothing from outside: {url}")
        content, media_type = self._contents[url]
        return URLFetcherResponse(url, content, {"Content-Type": media_type})
