"""What all pages answer alike: files, changes, diagnosis, what is made; title, words without script."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError
from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request as HttpRequest
from starlette.responses import FileResponse, HTMLResponse, JSONResponse, Response
from starlette.routing import Route

from zlmreport.document.typesetting.resources import find_page_file
from zlmreport.document.typesetting.templates import WorkbenchContext, render
from zlmreport.errors import ZlmreportError, write_problems
from zlmreport.language import Language, find_accepted_language
from zlmreport.web.changes import ConflictError, NothingToUndoError, Request
from zlmreport.web.commands import FileCommands, Wanted
from zlmreport.web.diagnoses import Diagnoses
from zlmreport.web.guard import Door, DoorKeeper
from zlmreport.web.making import draw_page
from zlmreport.web.texts import NO_SCRIPT, TITLE, collect_texts
from zlmreport.web.watched import LoadedFile, WatchedFile

#: What a page sends.
_Sent = TypeVar("_Sent", bound=BaseModel)

OTHER_PAGE = "the request is none of a page of this version"


class PageAnswers:
    """The answers that pages of all kinds have alike; what is shown and what a click does, each kind says."""

    __slots__ = ()

    bench: WatchedFile[LoadedFile]  #: The file.
    #: diagnoses and commands: Made beside, each in a process of its own.
    diagnoses: Diagnoses
    commands: FileCommands

    def view(self, language: Language) -> dict[str, Any]:
        """Return all that the page shows at once."""
        raise NotImplementedError

    def list_results(self, language: Language) -> dict[str, Any]:
        """Return what takes longer than the graphs, the fall of the error first."""
        raise NotImplementedError

    def compare_before_and_after(self, wanted: str, test: str, language: Language) -> dict[str, Any]:
        """Return what the graphs draw before and after a step of the model, or an effect that it may lack."""
        raise NotImplementedError

    def carry_out(self, wanted: Request) -> None:
        """Do what a click asks for."""
        raise NotImplementedError

    def list_stamps(self) -> dict[str, str]:
        """Return the state of all files: a page that shows another one asks for what follows anew."""
        return {"stamp": self.bench.make_stamp()}

    def describe_making(self, state: dict[str, Any], language: Language) -> dict[str, Any]:  # noqa: ARG002 - as it is
        """Return how far something is that is being made, as the page shows it."""
        return state

    def list_page_texts(self, language: Language) -> dict[str, str]:
        """Return the words of the page."""
        return collect_texts(language)

    def start_early(self) -> None:
        """Start what the first diagnosis need not wait for."""
        self.diagnoses.start_early()

    def end(self) -> None:
        """End what is under way beside, and take its files away."""
        self.diagnoses.end()
        self.commands.end()

    def make_app(self, door: Door) -> DoorKeeper:
        """Return the application behind its guard."""
        return DoorKeeper(self.make_unguarded_app(), door)

    def make_unguarded_app(self) -> Starlette:
        """Return the application, without a guard: behind one of its own, or that of a folder."""
        return Starlette(routes=[*self._list_routes(), *self.list_own_routes()])

    def list_own_routes(self) -> list[Route]:
        """Return the addresses that no other kind of page has."""
        raise NotImplementedError

    def _list_routes(self) -> list[Route]:
        return [
            Route("/", self.answer_page),
            Route("/files/{name}", answer_with_file),
            Route("/documents/{name}", self.answer_document),
            Route("/documents/{name}/{page:int}.png", self.answer_picture),
            Route("/api/texts", self.answer_texts),
            Route("/api/job", self.answer_job),
            Route("/api/stamp", self.answer_stamp),
            Route("/api/results", self.answer_results),
            Route("/api/step", self.answer_step),
            Route("/api/diagnosis", self.answer_diagnosis),
            Route("/api/diagnosis/stop", self.stop_diagnosis, methods=["POST"]),
            Route("/api/change", self.change, methods=["POST"]),
            Route("/api/made/{name}", self.answer_making),
            Route("/api/made/{name}/stop", self.stop_making, methods=["POST"]),
            Route("/api/made/{name}", self.make, methods=["POST"]),
        ]

    async def answer_page(self, request: HttpRequest) -> Response:
        """Answer with the page of the file, or of a part of it; it fills itself."""
        return answer_with_shell(await run_in_threadpool(self.choose_language, request), self.bench.path.name)

    async def answer_document(self, request: HttpRequest) -> Response:
        """Answer with a file that was made from the page, by its name."""
        path = self.commands.find_file(request.path_params["name"])
        return Response(status_code=404) if path is None else FileResponse(path, filename=path.name)

    async def answer_picture(self, request: HttpRequest) -> Response:
        """Answer with a page of a PDF that was made from the page, as a picture."""
        path = self.commands.find_file(request.path_params["name"])
        if path is None or path.suffix != ".pdf":
            return Response(status_code=404)
        found = await run_in_threadpool(draw_page, path, request.path_params["page"])
        return Response(status_code=404) if found is None else Response(found, media_type="image/png")

    async def answer_texts(self, request: HttpRequest) -> Response:
        """Answer with the words of the page."""
        return JSONResponse(self.list_page_texts(await run_in_threadpool(self.choose_language, request)))

    async def answer_job(self, request: HttpRequest) -> Response:
        """Answer with the file as values."""
        return await self.answer(request, lambda: self.view(self.choose_language(request)))

    async def answer_stamp(self, _: HttpRequest) -> Response:
        """Answer with the state of all files."""
        return JSONResponse(await run_in_threadpool(self.list_stamps))

    async def answer_results(self, request: HttpRequest) -> Response:
        """Answer with what takes longer than the graphs."""
        return await self.answer(request, lambda: self.list_results(self.choose_language(request)))

    async def answer_step(self, request: HttpRequest) -> Response:
        """Answer with the graphs before and after a step of the model, or an effect that it may lack."""

        def compare() -> dict[str, Any]:
            wanted, test = (request.query_params.get(name, "")[:500] for name in ("of", "test"))
            return self.compare_before_and_after(wanted, test, self.choose_language(request))

        return await self.answer(request, compare)

    async def answer_diagnosis(self, request: HttpRequest) -> Response:
        """Answer with the diagnosis of the file, or with the seconds for which it has been under way."""

        def find_diagnosis() -> dict[str, Any]:
            answer = self.diagnoses.find(self.bench.load().content)
            if "diagnosis" in answer:
                return {**answer, "diagnosis": answer["diagnosis"][self.choose_language(request).value]}
            return answer

        return await self.answer(request, find_diagnosis)

    async def stop_diagnosis(self, _: HttpRequest) -> Response:
        """Let go of the diagnosis that is under way."""
        await run_in_threadpool(self.diagnoses.stop)
        return JSONResponse({})

    async def answer_making(self, request: HttpRequest) -> Response:
        """Answer with how far something is that is being made."""
        making = self.commands.making.get(request.path_params["name"])
        if making is None:
            return Response(status_code=404)
        return await self.answer(
            request, lambda: self.describe_making(making.describe_state(), self.choose_language(request))
        )

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
        return await self.answer_wanted(request, Wanted, lambda wanted: self.commands.begin(name, wanted))

    async def change(self, request: HttpRequest) -> Response:
        """Do what a click asks for, and answer with the file as it is then."""

        def change_file(wanted: Request) -> dict[str, Any]:
            self.carry_out(wanted)
            return self.view(self.choose_language(request))

        return await self.answer_wanted(request, Request, change_file)

    async def answer_wanted(
        self, request: HttpRequest, kind: type[_Sent], work: Callable[[_Sent], dict[str, Any]]
    ) -> Response:
        """Answer with what some work comes to on what a page sends; refuse what none of this version does."""
        try:
            wanted = kind.model_validate_json(await request.body())
        except ValidationError:
            return JSONResponse({"problems": [OTHER_PAGE]}, 400)
        return await self.answer(request, lambda: work(wanted))

    async def answer(self, request: HttpRequest, work: Callable[[], dict[str, Any]]) -> Response:
        """Answer with what some work comes to, or with what stands against it."""
        try:
            return JSONResponse(await run_in_threadpool(work))
        except (ConflictError, NothingToUndoError) as error:
            language = await run_in_threadpool(self.choose_language, request)
            return JSONResponse({"problems": [error.words.in_language(language)]}, 409)
        except ZlmreportError as error:
            problems = [*write_problems(error.problems)]
            return JSONResponse({"problems": problems, "stamp": self.bench.make_stamp()}, 422)

    def choose_language(self, request: HttpRequest) -> Language:
        """Return the language of the page: that of its address, of the browser, or else of the file."""
        asked = find_language_of(request)
        if asked is not None:
            return asked
        try:
            return self.bench.load().language
        except ZlmreportError:
            return Language.ENGLISH


def answer_with_shell(language: Language, name: str) -> Response:
    """Return a page of the workbench, which fills itself; `name` is that of the file or the folder."""
    context = WorkbenchContext(
        language=language.value,
        title=f"{TITLE.in_language(language)} · {name}",
        needs_script=NO_SCRIPT.in_language(language),
    )
    return HTMLResponse(render(context))


async def answer_with_file(request: HttpRequest) -> Response:
    """Answer with a style sheet, a module, or a face of the typeface: one of a list, by its name."""
    found = find_page_file(request.path_params["name"])
    if found is None:
        return Response(status_code=404)
    return Response(found.content, media_type=found.media_type)


def find_language_of(request: HttpRequest) -> Language | None:
    """Return the language that an address or a browser asks for; None where neither does."""
    stated = request.query_params.get("lang", "")
    return find_accepted_language(stated) or find_accepted_language(
        request.headers.get("accept-language", "")
    )
