"""PDF, set by WeasyPrint: tagged, with bookmarks, the bundled typeface, and graphs as vectors."""

from __future__ import annotations

from zlmreport.plugin import AccessError, Place, Words, hookimpl
from zlmreport.plugin.renderer import Certificate


class PdfRenderer:
    """Certificates as PDF."""

    identifier = "pdf"
    title = Words("PDF, tagged for accessibility")
    suffix = ".pdf"
    carries_attachments = True

    def render(self, certificate: Certificate) -> bytes:
        """Return the PDF.

        Raises `AccessError` if WeasyPrint cannot be loaded, because the system lacks Pango.
        """
        try:
            from zlmreport_plugins.renderers.pdf.press import find_press
        except (ImportError, OSError) as error:
            raise AccessError.at(
                Place("pdf"),
                f"WeasyPrint cannot be loaded: {error}; it needs the library Pango "
                "(Debian, Ubuntu: apt-get install libpango-1.0-0 libpangoft2-1.0-0)",
            ) from error
        return find_press().print(certificate)


@hookimpl
def zlmreport_renderers() -> list[PdfRenderer]:
    """Offer the renderer."""
    return [PdfRenderer()]
