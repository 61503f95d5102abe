"""The book of jobs: a bounded queue, worker processes, and the results of finished jobs."""

from __future__ import annotations

import asyncio
import base64
import json
from collections import OrderedDict, deque
from contextlib import ExitStack, suppress
from typing import Any

from stonepass.web.answers import problem_document
from stonepass.web.jobs.job import ServerJob, Status
from stonepass.web.jobs.process import WorkerEnded, WorkerProcess
from stonepass.web.settings import ServerSettings
from stonepass.web.uploads.store import as_file

__all__ = ["JobBook", "QueueFull"]

NO_MEMORY = "The job needs more memory than the {memory} MB that the server allows."
FAULT = "This is an error of stonepass ({name}); please report it together with your request."
ENDED = (
    "The worker process ended before it had an answer ({how}); ask again, or make the question "
    "smaller if this repeats."
)
TOO_LONG = "The job took longer than the {seconds:g} s that the server allows."
SENTENCES = {
    Status.DONE: "The job is done.",
    Status.FAILED: "The job failed.",
    Status.CANCELLED: "The job was cancelled.",
}
RETRY = 10  # seconds after which a client may ask again, for each job that waits


class QueueFull(Exception):
    """No more jobs can wait.

    Attributes
    ----------
    retry_after : int
        Seconds after which a client should ask again.
    """

    def __init__(self, retry_after: int) -> None:
        super().__init__(retry_after)
        self.retry_after = retry_after


class JobBook:
    """All jobs by their fingerprints; they are done in the order in which they were asked.

    The methods must be called in the event loop of the server.

    Parameters
    ----------
    settings : ServerSettings
        Numbers of processes, of waiting jobs and of kept results; limits of time and memory.
    """

    def __init__(self, settings: ServerSettings) -> None:
        self._settings = settings
        self._jobs: OrderedDict[str, ServerJob] = OrderedDict()
        self._waiting: deque[ServerJob] = deque()
        self._arrived = asyncio.Event()
        self._running: dict[ServerJob, asyncio.Task[None]] = {}
        self._workers: list[asyncio.Task[None]] = []
        self.processes = [WorkerProcess() for _ in range(settings.workers)]

    def get(self, fingerprint: str) -> ServerJob | None:
        """Return the job with this fingerprint, or None."""
        self.forget_old()
        return self._jobs.get(fingerprint)

    def add(self, job: ServerJob) -> ServerJob:
        """Return the job of this fingerprint; a new one is queued if there is none that may answer.

        Raises
        ------
        QueueFull
            Too many jobs are waiting.
        """
        known = self.get(job.id)
        if known is not None and known.status not in (Status.FAILED, Status.CANCELLED):
            return known
        if len(self._waiting) >= self._settings.limits.waiting:
            raise QueueFull(RETRY * max(1, len(self._waiting) // self._settings.workers))
        self._jobs[job.id] = job
        self._jobs.move_to_end(job.id)
        self._waiting.append(job)
        self._arrived.set()
        if not self._workers:
            self._workers = [asyncio.create_task(self._work(each)) for each in self.processes]
        return job

    async def cancel(self, job: ServerJob) -> None:
        """End a job that waits or runs; forget one that has ended."""
        if job.status.ended:
            self._jobs.pop(job.id, None)
        elif job in self._running:
            self._running[job].cancel()
            await asyncio.wait({self._running[job]})
            self._end(job, Status.CANCELLED)
        else:
            with suppress(ValueError):
                self._waiting.remove(job)
            self._end(job, Status.CANCELLED)

    async def close(self) -> None:
        """End all workers and their processes."""
        for task in self._workers:
            task.cancel()
        await asyncio.gather(*self._workers, return_exceptions=True)
        await asyncio.gather(*(each.end() for each in self.processes))

    async def _work(self, process: WorkerProcess) -> None:
        """Do jobs with one process as long as the server runs."""
        while True:
            job = await self._next(process)
            job.change(status=Status.RUNNING, progress=_progress("The job has begun."))
            task = asyncio.create_task(self._do(job, process))
            self._running[job] = task
            try:
                await asyncio.wait({task})
            except asyncio.CancelledError:  # the server ends
                task.cancel()
                await asyncio.wait({task})
                raise
            finally:
                del self._running[job]
            if task.cancelled():
                await process.end()
                if not job.status.ended:
                    self._end(job, Status.CANCELLED)
            elif (fault := task.exception()) is not None:  # e.g. a full disk
                await process.end()
                if not job.status.ended:
                    self._fail(job, FAULT.format(name=type(fault).__name__), 500)

    async def _next(self, process: WorkerProcess) -> ServerJob:
        """Return the next job; an idle process is ended after a while."""
        while not self._waiting:
            self._arrived.clear()
            idle = self._settings.limits.idle_seconds if process.pid is not None else None
            try:
                await asyncio.wait_for(self._arrived.wait(), idle)
            except TimeoutError:
                await process.end()
        return self._waiting.popleft()

    async def _do(self, job: ServerJob, process: WorkerProcess) -> None:
        """Do one job and note its result, or why it failed."""
        limits = self._settings.limits
        folder = self._settings.cache_folder
        request: dict[str, Any] = {
            "kind": job.kind,
            "body": job.body,
            "cache_folder": None if folder is None else str(folder),
            "file": None,
            "area": None,
            "format": job.format,
            "memory": limits.job_memory,
        }
        try:
            with ExitStack() as files:
                if job.upload is not None:  # the file exists only while it is read
                    file = files.enter_context(as_file(job.upload.ending, job.upload.content))
                    request |= {"file": str(file), "area": job.upload.area}
                async with asyncio.timeout(limits.job_seconds):
                    message = await process.run(request, lambda told: job.change(progress=told))
        except TimeoutError:
            await process.end()
            self._fail(job, TOO_LONG.format(seconds=limits.job_seconds), 422)
        except WorkerEnded as problem:
            if problem.lacked_memory:
                self._lacked_memory(job)
            else:
                self._fail(job, ENDED.format(how=problem.how), 409)
        else:
            await self._conclude(job, message, process)

    async def _conclude(
        self, job: ServerJob, message: dict[str, Any], process: WorkerProcess
    ) -> None:
        if "result" in message:
            job.result, job.report = message["result"], base64.b64decode(message["report"])
            job.size = len(json.dumps(job.result)) + len(job.report)
            self._end(job, Status.DONE)
        elif "refused" in message:
            detail, field, value = message["refused"]
            self._fail(job, detail, 422, field, value)
        elif message["fault"] == "MemoryError":
            await process.end()  # what is left of its memory may not be enough for the next job
            self._lacked_memory(job)
        else:
            self._fail(job, FAULT.format(name=message["fault"]), 500)

    def _lacked_memory(self, job: ServerJob) -> None:
        memory = self._settings.limits.job_memory // 1_000_000
        self._fail(job, NO_MEMORY.format(memory=memory), 422)

    def _fail(
        self, job: ServerJob, detail: str, status: int, field: str = "", value: str = ""
    ) -> None:
        job.problem = problem_document(status, detail, field or None, value or None)
        self._end(job, Status.FAILED)

    def _end(self, job: ServerJob, status: Status) -> None:
        """Note that a job has ended, and drop its question, its file and what is too old."""
        job.change(
            status=status,
            ended_at=asyncio.get_running_loop().time(),
            body={},
            upload=None,
            progress=_progress(SENTENCES[status]),
        )
        self.forget_old()

    def forget_old(self) -> None:
        """Forget the oldest of the jobs that have ended, and those that ended long ago."""
        limits, now = self._settings.limits, asyncio.get_running_loop().time()
        ended = sorted((job for job in self._jobs.values() if job.status.ended),
                       key=lambda job: job.ended_at, reverse=True)  # fmt: skip
        size = 0
        for place, job in enumerate(ended):
            size += job.size
            many = place >= limits.finished or (place > 0 and size > limits.results)
            if many or now - job.ended_at > limits.result_seconds:
                self._jobs.pop(job.id, None)


def _progress(sentence: str) -> dict[str, Any]:
    return {"done": 0, "total": 0, "sentence": sentence}
