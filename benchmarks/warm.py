"""One certificate after the other in processes that have made some before."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

from alike import pages_of_same_document
from content import Content, content
from measure import Cost, Measured, Sizes, median, own_process, ratio, that_count, timed
from sample import write_job
from zlmreport.job.loading import load
from zlmreport.pipeline import compose
from zlmreport.plugins import Registry, find_plugins

#: For tagged PDF by WeasyPrint, graphs drawn with matplotlib's help, and tables that are tables.
_TARGET = 0.40


@dataclass(frozen=True, slots=True)
class _Product:
    """A certificate by zlmreport: what its document and its PDF cost, and both."""

    document: Cost
    pdf: Cost
    content: Content
    graphs: int
    printed: bytes


@dataclass(frozen=True, slots=True)
class _Plain:
    """The same document by the plain recipe."""

    pdf: Cost
    printed: bytes


@dataclass(frozen=True, slots=True)
class _Round:
    """One certificate in each way."""

    product: _Product
    through_svg: _Product
    plain: _Plain


def measure(sizes: Sizes) -> list[Measured]:
    """Measure each way in a process of its own, and all in turn: A B C A B C."""
    with (
        TemporaryDirectory() as folder,
        own_process() as first,
        own_process() as second,
        own_process() as third,
    ):
        made = []
        for number in range(sizes.rounds):
            job = write_job(Path(folder), f"WARM-{number:04}")
            product = first.submit(_by_zlmreport, job).result()
            through_svg = second.submit(_by_zlmreport_through_svg, job).result()
            plain = third.submit(_by_plain_recipe, product.content).result()
            made.append(_Round(product, through_svg, plain))
    rounds = that_count(made)
    product, plain = rounds[0].product, rounds[0].plain
    pages, plain_pages = pages_of_same_document(product.content, product.printed, plain.printed)
    document = [each.product.document.cpu for each in rounds]
    pdf = [each.product.pdf.cpu for each in rounds]
    through_svg_pdf = [each.through_svg.pdf.cpu for each in rounds]
    plain_pdf = [each.plain.pdf.cpu for each in rounds]
    job_to_pdf = [each.product.document.wall + each.product.pdf.wall for each in rounds]
    return [
        Measured("graphs", product.graphs),
        Measured("pages by zlmreport", pages),
        Measured("pages by the plain recipe", plain_pages),
        Measured("zlmreport, job to document", 1e3 * median(document), "ms CPU"),
        Measured("zlmreport, document to PDF", 1e3 * median(pdf), "ms CPU"),
        Measured(
            "zlmreport with graphs through SVG, document to PDF", 1e3 * median(through_svg_pdf), "ms CPU"
        ),
        Measured("plain recipe, document to PDF", 1e3 * median(plain_pdf), "ms CPU"),
        Measured("zlmreport / plain recipe", ratio(pdf, plain_pdf), "", _TARGET),
        Measured("zlmreport with graphs through SVG / plain recipe", ratio(through_svg_pdf, plain_pdf)),
        Measured("zlmreport, job to PDF", 1 / median(job_to_pdf), "per s"),
        Measured(
            "plain recipe, document to PDF", 1 / median(each.plain.pdf.wall for each in rounds), "per s"
        ),
    ]


@cache
def _registry() -> Registry:
    return find_plugins()


def _by_zlmreport(job: Path) -> _Product:
    registry = _registry()
    of_document, certificate = timed(lambda: compose(load(job, registry), registry))
    of_pdf, pdf = timed(lambda: registry.renderer("pdf").render(certificate))
    return _Product(of_document, of_pdf, content(certificate), len(certificate.figures), pdf)


def _by_zlmreport_through_svg(job: Path) -> _Product:
    from zlmreport_plugins.renderers.pdf import press  # noqa: PLC0415 - in this process only

    press.DRAWS_ON_PAGES = False
    return _by_zlmreport(job)


def _by_plain_recipe(words: Content) -> _Plain:
    import plain  # noqa: PLC0415 - it changes matplotlib's configuration

    return _Plain(*timed(lambda: plain.certificate(words)))
