"""One certificate after the other in processes that have made some before."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from xml.etree import ElementTree as ET

from alike import pages_of_same_document
from content import Content, content
from measure import Cost, Measured, Sizes, cpu, median, own_process, ratio, that_count, timed, wall
from sample import write_job
from zlmreport.job.loading import load
from zlmreport.pipeline import run
from zlmreport.plugin.registry import Registry, find_plugins

#: For tagged PDF by WeasyPrint, graphs as vectors, and tables that are tables.
_TARGET = 0.40


@dataclass(frozen=True, slots=True)
class _Product:
    """A certificate by zlmreport, from the job to the PDF."""

    cost: Cost
    pdf: bytes
    content: Content
    graphs: int


@dataclass(frozen=True, slots=True)
class _Plain:
    """The same document by the plain recipe, from its content to the PDF."""

    cost: Cost
    pdf: bytes


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
    pages, plain_pages = pages_of_same_document(product.content, product.pdf, plain.pdf)
    costs = [each.product.cost for each in rounds]
    svg_costs = [each.through_svg.cost for each in rounds]
    plain_costs = [each.plain.cost for each in rounds]
    return [
        Measured("graphs", product.graphs),
        Measured("pages by zlmreport", pages),
        Measured("pages by the plain recipe", plain_pages),
        Measured("zlmreport, from the job", 1e3 * median(cpu(costs)), "ms CPU"),
        Measured("zlmreport with graphs through SVG", 1e3 * median(cpu(svg_costs)), "ms CPU"),
        Measured("plain recipe, from the document", 1e3 * median(cpu(plain_costs)), "ms CPU"),
        Measured("zlmreport / plain recipe", ratio(cpu(costs), cpu(plain_costs)), "", _TARGET),
        Measured("with graphs through SVG / plain recipe", ratio(cpu(svg_costs), cpu(plain_costs))),
        Measured("zlmreport, one process", 1 / median(wall(costs)), "per s"),
        Measured("plain recipe, one process", 1 / median(wall(plain_costs)), "per s"),
    ]


@cache
def _registry() -> Registry:
    return find_plugins()


def _by_zlmreport(job: Path) -> _Product:
    registry = _registry()
    cost, outcome = timed(lambda: run(load(job, registry), registry))
    certificate = outcome.certificate
    return _Product(cost, outcome.documents[0].content, content(certificate), len(certificate.figures))


def _by_zlmreport_through_svg(job: Path) -> _Product:
    from weasyprint.images import SVGImage  # noqa: PLC0415 - in this process only

    from zlmreport.document.figures.draw import to_svg  # noqa: PLC0415 - in this process only
    from zlmreport_plugins.renderers.pdf import press  # noqa: PLC0415 - in this process only

    class Svg(press.PageGraph):  # type: ignore[misc]
        """A figure as an image that WeasyPrint reads from SVG and draws itself."""

        def draw(self, stream: Any, concrete_width: float, concrete_height: float, style: Any) -> None:
            drawing = ET.fromstring(to_svg(self._figure, self._language))
            SVGImage(drawing, "", None, style).draw(stream, concrete_width, concrete_height, style)

    press.PageGraph = Svg
    return _by_zlmreport(job)


def _by_plain_recipe(words: Content) -> _Plain:
    import plain  # noqa: PLC0415 - it changes matplotlib's configuration

    return _Plain(*timed(lambda: plain.certificate(words)))
