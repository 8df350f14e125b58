"""What the server answers for a folder of jobs: the list, and behind each of its jobs a workbench."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from threading import Lock
from typing import Any

from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request as HttpRequest
from starlette.responses import JSONResponse, Response
from starlette.routing import Mount, Route
from starlette.types import Receive, Scope, Send

from zlmreport.errors import ZlmreportError
from zlmreport.language import Language
from zlmreport.plugin.registry import Registry
from zlmreport.web.answers import answer_with_file, answer_with_shell, find_language_of
from zlmreport.web.app import Workbench
from zlmreport.web.folder import JobFolder, collect_row, is_machine
from zlmreport.web.guard import Door, DoorKeeper
from zlmreport.web.machine_app import MachineWorkbench
from zlmreport.web.texts import collect_texts


@dataclass(slots=True)
class FolderWorkbench:
    """The answers for a folder of jobs; the workbench of a job begins when it is opened."""

    folder: JobFolder
    registry: Registry
    plugins: Sequence[Path] = ()  #: Files that are plugins, from the command line.
    _opened: dict[str, tuple[Workbench | MachineWorkbench, Starlette]] = field(default_factory=dict)
    _lock: Lock = field(default_factory=Lock)

    def warm_up(self) -> None:
        """Begin to look at the jobs, so that the page need not wait."""
        self.folder.list_rows()

    def end(self) -> None:
        """End what is under way beside, and take its files away."""
        with self._lock:
            opened, self._opened = self._opened, {}
        for workbench, _ in opened.values():
            workbench.end()

    def make_app(self, door: Door) -> DoorKeeper:
        """Return the application behind its guard."""
        routes = [
            Route("/", self.answer_page),
            Route("/files/{name}", answer_with_file),
            Route("/api/texts", self.answer_texts),
            Route("/api/folder", self.answer_jobs),
            Mount("/jobs/{key}", self.hand_on),
        ]
        return DoorKeeper(Starlette(routes=routes), door)

    async def answer_page(self, request: HttpRequest) -> Response:
        """Answer with the page of the folder; it fills itself."""
        return answer_with_shell(self._choose_language(request), self.folder.path.resolve().name)

    async def answer_texts(self, request: HttpRequest) -> Response:
        """Answer with the words of the page, and that it is one of a folder."""
        return JSONResponse(
            {**collect_texts(self._choose_language(request)), "folder": str(self.folder.path.resolve().name)}
        )

    async def answer_jobs(self, request: HttpRequest) -> Response:
        """Answer with the jobs, the worst first."""

        def found() -> dict[str, Any]:
            return {
                "jobs": [
                    collect_row(each, self._choose_language(request)) for each in self.folder.list_rows()
                ]
            }

        try:
            return JSONResponse(await run_in_threadpool(found))
        except ZlmreportError as error:
            return JSONResponse({"problems": [str(each) for each in error.problems]}, 422)

    async def hand_on(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Hand a request on to the workbench of a job."""
        answer = await run_in_threadpool(self._find_workbench, scope["path_params"]["key"])
        await (answer or Response(status_code=404))(scope, receive, send)

    def _find_workbench(self, key: str) -> Starlette | None:
        with self._lock:
            if key not in self._opened:
                path = self.folder.list_paths().get(key)
                if path is None:
                    return None
                kind = MachineWorkbench if is_machine(path) else Workbench
                workbench = kind.on(path, self.registry, self.plugins)
                self._opened[key] = workbench, workbench.make_unguarded_app()
            return self._opened[key][1]

    def _choose_language(self, request: HttpRequest) -> Language:
        return find_language_of(request) or Language.ENGLISH
