"""A plugin in a file of its own, for workers: a quick certificate, unless the job's number says otherwise."""

from __future__ import annotations

PLUGIN = """\
import os
import signal
import tempfile
from pathlib import Path

from offers import offering
from testing.exemplary import ExemplaryRenderer, ExemplarySource, ExemplaryStandard

STANDARD, SOURCE = ExemplaryStandard(), ExemplarySource()


class Deadly(ExemplaryRenderer):
    suffix = ".pid"

    def render(self, certificate):
        deed = certificate.number.removeprefix("CAL-").rstrip("0123456789")
        folder = Path(certificate.job.files[0].path).parent
        tempfile.mkstemp()
        if deed == "KILLED":
            os.kill(os.getpid(), signal.SIGKILL)
        if deed == "KILLED-ONCE" and not (folder / "killed").exists():
            (folder / "killed").touch()
            os.kill(os.getpid(), signal.SIGKILL)
        if deed == "SCHEDULER" and (folder / "scheduler").exists():
            (folder / "scheduler").rename(folder / "killed-scheduler")
            os.kill(int((folder / "killed-scheduler").read_text()), signal.SIGKILL)
        return str(os.getpid()).encode()


offer = offering([STANDARD], [SOURCE], [Deadly()])
zlmreport_standards = offer.zlmreport_standards
zlmreport_sources = offer.zlmreport_sources
zlmreport_renderers = offer.zlmreport_renderers
"""
