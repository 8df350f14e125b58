"""PTB's Digital Calibration Certificate 3.3.0: written, and its readings read again."""

from __future__ import annotations

from zlmreport.plugin import InputError, Place, Words, hookimpl
from zlmreport.plugin.renderer import Certificate, Relationship
from zlmreport.plugin.source import DataSource
from zlmreport_plugins.renderers.dcc.administrative import make_administrative_data
from zlmreport_plugins.renderers.dcc.elements import SCHEMA_LOCATION, VERSION, dcc, write_document
from zlmreport_plugins.renderers.dcc.results import make_measurement_results
from zlmreport_plugins.renderers.dcc.source import DccSource


class DccRenderer:
    """PTB's Digital Calibration Certificate (PTB, DCC schema 3.3.0, with D-SI 2.2.1).

    The same numbers as the results file, at full precision, with units, uncertainties, conditions and
    statements of conformity.
    """

    identifier = "dcc"
    title = Words("Digital calibration certificate (DCC, XML)")
    suffix = ".xml"
    relationship = Relationship.ALTERNATIVE
    needs_job = True

    def render(self, certificate: Certificate) -> bytes:
        """Return the file, UTF-8.

        Raises `InputError` with everything that a DCC must state and the job does not.
        """
        job = certificate.job
        if job is None:
            raise InputError.at(
                Place(certificate.number),
                "a DCC states what a job measured, and this document is of none; take dcc out of its formats",
            )
        root = dcc(
            "digitalCalibrationCertificate",
            make_administrative_data(certificate, job),
            make_measurement_results(certificate, job),
            schemaVersion=VERSION,
        )
        root.attrib.update(SCHEMA_LOCATION)
        return write_document(root)


@hookimpl
def zlmreport_renderers() -> list[DccRenderer]:
    """Offer the renderer."""
    return [DccRenderer()]


@hookimpl
def zlmreport_sources() -> list[DataSource]:
    """Offer the reader."""
    return [DccSource()]
