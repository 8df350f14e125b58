"""The server of a job's workbench: where it listens, its addresses, the steps of its model, changes."""

from __future__ import annotations

import socket
import webbrowser
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import uvicorn
from starlette.requests import Request as HttpRequest
from starlette.responses import Response
from starlette.routing import Route

from zlmreport.errors import AccessError, InputError, Place
from zlmreport.language import Language
from zlmreport.plugin.registry import Registry
from zlmreport.web.answers import OTHER_PAGE, PageAnswers
from zlmreport.web.bench import PLACE, Bench
from zlmreport.web.capture_page import CapturePage
from zlmreport.web.capturing import CaptureRequest
from zlmreport.web.changes import Request, change
from zlmreport.web.commands import Commands
from zlmreport.web.comparison import ComparedTests
from zlmreport.web.diagnoses import Diagnoses, DiagnosesByContent
from zlmreport.web.effect_page import make_effect_page
from zlmreport.web.folded import fold
from zlmreport.web.guard import HOST, Door
from zlmreport.web.view import add_stairs, collect_before_and_after, collect_closer, make_results, make_view

if TYPE_CHECKING:
    from zlmreport.web.folder import FolderWorkbench


@dataclass(frozen=True, slots=True)
class Workbench(PageAnswers):
    """The answers for one job."""

    bench: Bench  #: The job.
    comparison: ComparedTests  #: Other tests of its axis beside it.
    #: diagnoses and commands: Made beside, each in a process of its own.
    diagnoses: Diagnoses
    commands: Commands
    capture: CapturePage  #: Of its readings, where a live instrument takes them.

    @classmethod
    def of(cls, jobs: Sequence[Path], registry: Registry, plugins: Sequence[Path] = ()) -> Workbench:
        """Return the answers for a job, the first, beside other tests of its axis.

        Raises `InputError` or `AccessError` as `Bench.load`; or if a job is no test of the axis of the
        first.
        """
        job, *others = jobs
        bench = Bench(job, registry)
        if not others and CapturePage.of(bench, plugins).is_awaited():
            return cls.on(job, registry, plugins)
        bench.load()
        comparison = ComparedTests.of(bench, [Bench(each, registry) for each in others])
        diagnoses = Diagnoses(job, DiagnosesByContent.of_user(registry.effects), plugins)
        return cls(bench, comparison, diagnoses, Commands.of(bench, plugins), CapturePage.of(bench, plugins))

    @classmethod
    def on(cls, job: Path, registry: Registry, plugins: Sequence[Path] = ()) -> Workbench:
        """Return the answers for a job alone, whether or not it can be read: the page says what is wrong."""
        bench = Bench(job, registry)
        diagnoses = Diagnoses(job, DiagnosesByContent.of_user(registry.effects), plugins)
        compared = ComparedTests.of(bench, [])
        return cls(bench, compared, diagnoses, Commands.of(bench, plugins), CapturePage.of(bench, plugins))

    def end(self) -> None:
        """End what is under way beside, its capture, too."""
        PageAnswers.end(self)
        self.capture.process.end()

    def list_own_routes(self) -> list[Route]:
        """Return the addresses of effects, of tests side by side, and of a capture."""
        return [
            Route("/effects/{effect}", self.answer_page),
            Route("/api/closer", self.answer_closer),
            Route("/api/tests", self.answer_tests),
            Route("/api/effects/{effect}", self.answer_effect),
            Route("/api/folded", self.answer_folded),
            Route("/api/capture", self.answer_capture),
            Route("/api/capture", self.change_capture, methods=["POST"]),
        ]

    def view(self, language: Language) -> dict[str, Any]:
        """Return the page of the job."""
        return make_view(self.bench, self.bench.load(), language)

    def list_results(self, language: Language) -> dict[str, Any]:
        """Return the fall of the error, and what the standards say."""
        return make_results(self.bench, self.bench.load(), language)

    def compare_before_and_after(self, wanted: str, test: str, language: Language) -> dict[str, Any]:  # noqa: ARG002 - there is one
        """Return what the graphs draw before and after a step of the model, or an effect that it may lack."""
        return collect_before_and_after(self.bench, self.bench.load(), wanted, language)

    def carry_out(self, wanted: Request) -> None:
        """Do what a click asks for."""
        change(self.bench, wanted)

    def list_stamps(self) -> dict[str, str]:
        """Return the state of all files, also of the tests beside that of the job."""
        return {"stamp": self.bench.make_stamp(), "tests": self.comparison.make_stamp()}

    def describe_making(self, state: dict[str, Any], language: Language) -> dict[str, Any]:
        """Return how far something is that is being made, a build with its staircase."""
        bench = self.bench
        return add_stairs(state, bench.load().job, bench.registry, language)

    async def answer_folded(self, request: HttpRequest) -> Response:
        """Answer with an effect that repeats, on one period; with nothing for any other effect."""

        def fold_wave() -> dict[str, Any]:
            wanted = request.query_params.get("of", "")[:500]
            wave = fold(self.bench, self.bench.load(), wanted, self.choose_language(request))
            return {"wave": wave}

        return await self.answer(request, fold_wave)

    async def answer_closer(self, request: HttpRequest) -> Response:
        """Answer with the curves of the model on the part of the travel that a page shows."""

        def look_closer() -> dict[str, Any]:
            try:
                ends = float(request.query_params["low"]), float(request.query_params["high"])
            except (KeyError, ValueError) as error:
                raise InputError.at(PLACE, OTHER_PAGE) from error
            return collect_closer(self.bench, self.bench.load(), ends)

        return await self.answer(request, look_closer)

    async def answer_tests(self, request: HttpRequest) -> Response:
        """Answer with the other tests of the axis beside that of the job."""
        return await self.answer(request, lambda: self.comparison.list_values(self.choose_language(request)))

    async def answer_effect(self, request: HttpRequest) -> Response:
        """Answer with what there is to say of an effect."""

        def describe_effect() -> dict[str, Any]:
            effect = request.path_params["effect"]
            values = make_effect_page(self.bench, self.bench.load(), effect, self.choose_language(request))
            if values is None:
                raise InputError.at(PLACE, f"there is no effect {effect[:60]!r}")
            return values

        return await self.answer(request, describe_effect)

    async def answer_capture(self, request: HttpRequest) -> Response:
        """Answer with how far the capture of the readings is."""
        return await self.answer(request, lambda: self.capture.list_values(self.choose_language(request)))

    async def change_capture(self, request: HttpRequest) -> Response:
        """Do what a click on the page of a capture asks for, and answer with how far it is then."""

        def carry_out(wanted: CaptureRequest) -> dict[str, Any]:
            self.capture.carry_out(wanted)
            return self.capture.list_values(self.choose_language(request))

        return await self.answer_wanted(request, CaptureRequest, carry_out)


def serve(
    workbench: PageAnswers | FolderWorkbench, port: int, ready: Callable[[str], None], *, open_browser: bool
) -> None:
    """Listen on the loopback address until the user ends it; the workbench ends then, or if it cannot begin.

    `port`: On which; 0 for any free one.
    """
    try:
        with _listen(port) as listener:
            door = Door.at(listener.getsockname()[1])
            server = uvicorn.Server(
                uvicorn.Config(workbench.make_app(door), log_level="warning", access_log=False)
            )
            workbench.start_early()
            ready(door.address)  # the socket listens already: who comes early waits
            if open_browser:
                webbrowser.open(door.address)
            server.run(sockets=[listener])
    finally:
        workbench.end()


def _listen(port: int) -> socket.socket:
    """Return a socket on the loopback address, and on no other."""
    listener = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listener.bind((HOST, port))
        listener.listen()
    except OSError as error:
        listener.close()
        reason = (error.strerror or str(error)).lower()
        raise AccessError.at(
            Place("zlmreport workbench"), f"port {port} cannot be used: {reason}; choose another with --port"
        ) from error
    return listener
