"""What the server answers: the page and its files, the job as values, changes, the certificate."""

from __future__ import annotations

import socket
import webbrowser
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import uvicorn
from pydantic import ValidationError
from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request as HttpRequest
from starlette.responses import FileResponse, HTMLResponse, JSONResponse, Response
from starlette.routing import Route

from zlmreport.document.typesetting.resources import page_file
from zlmreport.document.typesetting.templates import WorkbenchContext, render
from zlmreport.errors import AccessError, InputError, Place, ZlmreportError
from zlmreport.language import Language, Words, accepted_language
from zlmreport.plugin.registry import Registry
from zlmreport.web.bench import PLACE, Bench
from zlmreport.web.capture_page import CapturePage
from zlmreport.web.capturing import CaptureRequest
from zlmreport.web.changes import ConflictError, NothingToUndoError, Request, change
from zlmreport.web.commands import Commands, Wanted
from zlmreport.web.comparison import ComparedTests
from zlmreport.web.diagnoses import Diagnoses, DiagnosesByContent
from zlmreport.web.effect_page import effect_page
from zlmreport.web.folded import folded
from zlmreport.web.guard import HOST, Door, DoorKeeper
from zlmreport.web.making import page_picture
from zlmreport.web.stairs import with_stairs
from zlmreport.web.texts import texts
from zlmreport.web.view import before_and_after, closer, results, view

_OTHER_PAGE = "the request is none of a page of this version"
_TITLE = Words("Workbench")
_NO_SCRIPT = Words("The workbench needs JavaScript, which comes from this computer alone.")


@dataclass(frozen=True, slots=True)
class Workbench:
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

        Raises `InputError` or `AccessError` as `Bench.loaded`; or if a job is no test of the axis of the
        first.
        """
        job, *others = jobs
        bench = Bench(job, registry)
        if not others and CapturePage.of(bench, plugins).is_awaited():
            return cls.on(job, registry, plugins)
        bench.loaded()
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

    def warm_up(self) -> None:
        """Start what the first diagnosis need not wait for."""
        self.diagnoses.warm_up()

    def end(self) -> None:
        """End what is under way beside, and take its files away."""
        self.diagnoses.end()
        self.commands.end()
        self.capture.process.end()

    def app(self, door: Door) -> DoorKeeper:
        """Return the application behind its guard."""
        return DoorKeeper(self.routed(), door)

    def routed(self) -> Starlette:
        """Return the application, without a guard: behind one of its own, or that of a folder."""
        routes = [
            Route("/", self.page),
            Route("/effects/{effect}", self.page),
            Route("/files/{name}", file),
            Route("/documents/{name}", self.document),
            Route("/documents/{name}/{page:int}.png", self.picture),
            Route("/api/texts", self.texts),
            Route("/api/stamp", self.stamp),
            Route("/api/job", self.job),
            Route("/api/results", self.results),
            Route("/api/step", self.step),
            Route("/api/closer", self.closer),
            Route("/api/tests", self.tests),
            Route("/api/diagnosis", self.diagnosis),
            Route("/api/diagnosis/stop", self.stop, methods=["POST"]),
            Route("/api/effects/{effect}", self.effect),
            Route("/api/change", self.change, methods=["POST"]),
            Route("/api/folded", self.folded),
            Route("/api/made/{name}", self.made),
            Route("/api/made/{name}/stop", self.stop_making, methods=["POST"]),
            Route("/api/made/{name}", self.make, methods=["POST"]),
            Route("/api/capture", self.capturing),
            Route("/api/capture", self.captured, methods=["POST"]),
        ]
        return Starlette(routes=routes)

    async def page(self, request: HttpRequest) -> Response:
        """Answer with the page of the job, or of an effect; it fills itself."""
        return shell(await run_in_threadpool(self._language, request), self.bench.path.name)

    async def document(self, request: HttpRequest) -> Response:
        """Answer with a file that was made from the page, by its name."""
        path = self.commands.file(request.path_params["name"])
        return Response(status_code=404) if path is None else FileResponse(path, filename=path.name)

    async def picture(self, request: HttpRequest) -> Response:
        """Answer with a page of a PDF that was made from the page, as a picture."""
        path = self.commands.file(request.path_params["name"])
        if path is None or path.suffix != ".pdf":
            return Response(status_code=404)
        found = await run_in_threadpool(page_picture, path, request.path_params["page"])
        return Response(status_code=404) if found is None else Response(found, media_type="image/png")

    async def texts(self, request: HttpRequest) -> Response:
        """Answer with the words of the page."""
        return JSONResponse(texts(await run_in_threadpool(self._language, request)))

    async def stamp(self, _: HttpRequest) -> Response:
        """Answer with the state of all files: a page that shows another one asks for what follows anew."""
        stamps = await run_in_threadpool(lambda: (self.bench.stamp(), self.comparison.stamp()))
        return JSONResponse(dict(zip(("stamp", "tests"), stamps, strict=True)))

    async def job(self, request: HttpRequest) -> Response:
        """Answer with the job as values."""
        return await self._answered(request, lambda: self._view(request))

    async def results(self, request: HttpRequest) -> Response:
        """Answer with the fall of the error and what the standards say."""
        return await self._answered(
            request, lambda: results(self.bench, self.bench.loaded(), self._language(request))
        )

    async def step(self, request: HttpRequest) -> Response:
        """Answer with the graphs before and after a step of the model, or an effect that it may lack."""

        def found() -> dict[str, Any]:
            wanted = request.query_params.get("of", "")[:500]
            return before_and_after(self.bench, self.bench.loaded(), wanted, self._language(request))

        return await self._answered(request, found)

    async def folded(self, request: HttpRequest) -> Response:
        """Answer with an effect that repeats, on one period; with nothing for any other effect."""

        def found() -> dict[str, Any]:
            wanted = request.query_params.get("of", "")[:500]
            wave = folded(self.bench, self.bench.loaded(), wanted, self._language(request))
            return {"wave": wave}

        return await self._answered(request, found)

    async def closer(self, request: HttpRequest) -> Response:
        """Answer with the curves of the model on the part of the travel that a page shows."""

        def found() -> dict[str, Any]:
            try:
                ends = float(request.query_params["low"]), float(request.query_params["high"])
            except (KeyError, ValueError) as error:
                raise InputError.at(PLACE, _OTHER_PAGE) from error
            return closer(self.bench, self.bench.loaded(), ends)

        return await self._answered(request, found)

    async def tests(self, request: HttpRequest) -> Response:
        """Answer with the other tests of the axis beside that of the job."""
        return await self._answered(request, lambda: self.comparison.values(self._language(request)))

    async def diagnosis(self, request: HttpRequest) -> Response:
        """Answer with the diagnosis of the job, or with the seconds for which it has been under way."""

        def found() -> dict[str, Any]:
            answer = self.diagnoses.of(self.bench.loaded().content)
            if "diagnosis" in answer:
                return {**answer, "diagnosis": answer["diagnosis"][self._language(request).value]}
            return answer

        return await self._answered(request, found)

    async def stop(self, _: HttpRequest) -> Response:
        """Let go of the diagnosis that is under way."""
        await run_in_threadpool(self.diagnoses.stop)
        return JSONResponse({})

    async def effect(self, request: HttpRequest) -> Response:
        """Answer with what there is to say of an effect."""

        def found() -> dict[str, Any]:
            effect = request.path_params["effect"]
            values = effect_page(self.bench, self.bench.loaded(), effect, self._language(request))
            if values is None:
                raise InputError.at(PLACE, f"there is no effect {effect[:60]!r}")
            return values

        return await self._answered(request, found)

    async def made(self, request: HttpRequest) -> Response:
        """Answer with how far something is that is being made."""
        making = self.commands.making.get(request.path_params["name"])
        if making is None:
            return Response(status_code=404)

        def found() -> dict[str, Any]:
            bench = self.bench
            return with_stairs(making.state(), bench.loaded().job, bench.registry, self._language(request))

        return await self._answered(request, found)

    async def stop_making(self, request: HttpRequest) -> Response:
        """End what is being made."""
        making = self.commands.making.get(request.path_params["name"])
        if making is None:
            return Response(status_code=404)
        await run_in_threadpool(making.end)
        return JSONResponse({})

    async def make(self, request: HttpRequest) -> Response:
        """Begin to make something."""
        name = request.path_params["name"]
        if name not in self.commands.making:
            return Response(status_code=404)
        try:
            wanted = Wanted.model_validate_json(await request.body())
        except ValidationError:
            return JSONResponse({"problems": [_OTHER_PAGE]}, 400)
        return await self._answered(request, lambda: self.commands.begin(name, wanted))

    async def change(self, request: HttpRequest) -> Response:
        """Do what a click asks for, and answer with the job as it is then."""
        try:
            wanted = Request.model_validate_json(await request.body())
        except ValidationError:
            return JSONResponse({"problems": [_OTHER_PAGE]}, 400)

        def changed() -> dict[str, Any]:
            change(self.bench, wanted)
            return self._view(request)

        return await self._answered(request, changed)

    async def capturing(self, request: HttpRequest) -> Response:
        """Answer with how far the capture of the readings is."""
        return await self._answered(request, lambda: self.capture.values(self._language(request)))

    async def captured(self, request: HttpRequest) -> Response:
        """Do what a click on the page of a capture asks for, and answer with how far it is then."""
        try:
            wanted = CaptureRequest.model_validate_json(await request.body())
        except ValidationError:
            return JSONResponse({"problems": [_OTHER_PAGE]}, 400)

        def done() -> dict[str, Any]:
            self.capture.do(wanted)
            return self.capture.values(self._language(request))

        return await self._answered(request, done)

    async def _answered(self, request: HttpRequest, work: Callable[[], dict[str, Any]]) -> Response:
        try:
            return JSONResponse(await run_in_threadpool(work))
        except (ConflictError, NothingToUndoError) as error:
            language = await run_in_threadpool(self._language, request)
            return JSONResponse({"problems": [error.words.in_language(language)]}, 409)
        except ZlmreportError as error:
            problems = [str(each) for each in error.problems]
            return JSONResponse({"problems": problems, "stamp": self.bench.stamp()}, 422)

    def _view(self, request: HttpRequest) -> dict[str, Any]:
        return view(self.bench, self.bench.loaded(), self._language(request))

    def _language(self, request: HttpRequest) -> Language:
        """Return the language of the page: that of its address, of the browser, or else of the job."""
        asked = language_of(request)
        if asked is not None:
            return asked
        try:
            return self.bench.loaded().job.keys.certificate.language
        except ZlmreportError:
            return Language.ENGLISH


def shell(language: Language, name: str) -> Response:
    """Return a page of the workbench, which fills itself; `name` is that of the job or the folder."""
    context = WorkbenchContext(
        language=language.value,
        title=f"{_TITLE.in_language(language)} · {name}",
        needs_script=_NO_SCRIPT.in_language(language),
    )
    return HTMLResponse(render(context))


async def file(request: HttpRequest) -> Response:
    """Answer with a style sheet, a module, or a face of the typeface: one of a list, by its name."""
    found = page_file(request.path_params["name"])
    if found is None:
        return Response(status_code=404)
    return Response(found.content, media_type=found.media_type)


def language_of(request: HttpRequest) -> Language | None:
    """Return the language that an address or a browser asks for; None where neither does."""
    stated = request.query_params.get("lang", "")
    return accepted_language(stated) or accepted_language(request.headers.get("accept-language", ""))


class Served(Protocol):
    """What can be served: the page of a job, or that of a folder."""

    def app(self, door: Door) -> DoorKeeper:
        """Return the application behind its guard."""

    def warm_up(self) -> None:
        """Begin what a page would wait for."""

    def end(self) -> None:
        """End all that is under way."""


def serve(workbench: Served, port: int, ready: Callable[[str], None], *, open_browser: bool) -> None:
    """Listen on the loopback address until the user ends it; the workbench ends then, or if it cannot begin.

    `port`: On which; 0 for any free one.
    """
    try:
        with _listening(port) as listener:
            door = Door.at(listener.getsockname()[1])
            server = uvicorn.Server(
                uvicorn.Config(workbench.app(door), log_level="warning", access_log=False)
            )
            workbench.warm_up()
            ready(door.address)  # the socket listens already: who comes early waits
            if open_browser:
                webbrowser.open(door.address)
            server.run(sockets=[listener])
    finally:
        workbench.end()


def _listening(port: int) -> socket.socket:
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
