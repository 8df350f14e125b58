"""PDF, set by Typst: for fleets that count seconds; the same certificate as the format ``pdf``."""

from __future__ import annotations

from zlmreport.plugin import AccessError, InputError, Place, Words, hookimpl
from zlmreport.plugin.renderer import Certificate


class TypstRenderer:
    """Certificates as PDF, set by Typst."""

    identifier = "pdf-typst"
    title = Words("PDF, set by Typst")
    suffix = ".pdf"
    carries_attachments = True
    #: How its files begin the name of the program that made them.
    creator = "Typst "

    def render(self, certificate: Certificate) -> bytes:
        """Return the PDF.

        Raises `AccessError` if the package ``typst`` is not installed; `InputError` if the certificate has
        letters that the bundled typeface lacks, or a typeface or templates of its own.
        """
        if certificate.look.typeface or certificate.look.templates:
            raise InputError.at(
                certificate.look.place,
                "the format pdf-typst takes neither a typeface (certificate.style.typeface) nor templates "
                "(certificate.style.templates) of your own; ask for the format pdf",
            )
        try:
            from zlmreport_plugins.renderers.pdf_typst.press import find_press
        except ImportError as error:
            raise AccessError.at(
                Place("pdf-typst"),
                f"Typst cannot be loaded: {error}; install it with: pip install 'zlmreport[typst]'",
            ) from error
        return find_press().print(certificate)


@hookimpl
def zlmreport_renderers() -> list[TypstRenderer]:
    """Offer the renderer."""
    return [TypstRenderer()]
