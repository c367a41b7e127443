"""The objects that the routes share: made once per server, passed to the routes by dependency."""

from dataclasses import dataclass
from typing import Annotated

from fastapi import Depends
from starlette.requests import HTTPConnection

from vfcore.directories import jobs_directory
from vfcore.runs.gesture.render import RenderedGesture
from vocalis.server.http.access import Access, access_for, client_of
from vocalis.server.jobs.cache import LruCache
from vocalis.server.jobs.cluster import DaskCluster
from vocalis.server.jobs.events import EventLog
from vocalis.server.jobs.kinds.registry import result_formats
from vocalis.server.jobs.recorder import JobRecorder
from vocalis.server.jobs.retention import Limits
from vocalis.server.jobs.scheduler import Scheduler
from vocalis.server.jobs.service import JobService
from vocalis.server.jobs.storage import Storage
from vocalis.server.limiter import LatestFirstLimiter
from vocalis.server.live.host import VoiceHost
from vocalis.server.settings import Settings
from vocalis.server.warmup.state import Kernels

GESTURES_KEPT = 8  # 30 s of voice are 70 MB


@dataclass(frozen=True, slots=True)
class Services:
    """One of each. ``postures`` has a thread of its own: a posture takes 2 ms and must not wait for a run."""

    settings: Settings
    access: Access
    kernels: Kernels
    storage: Storage
    events: EventLog
    jobs: JobService
    postures: LatestFirstLimiter
    runs: LatestFirstLimiter
    voices: VoiceHost
    gestures: LruCache[RenderedGesture]

    @classmethod
    def of(cls, settings: Settings) -> "Services":
        """The services of a server with these settings; nothing is started yet."""
        token = settings.token.get_secret_value() if settings.token else None
        limits = Limits(settings.jobs_kept, settings.keep_days, settings.stored_bytes, settings.points_kept)
        directory = settings.jobs_directory or jobs_directory()
        storage, events = Storage(directory, settings.result_bytes, limits, result_formats()), EventLog()
        recorder = JobRecorder(storage.jobs, events)
        cluster = _cluster(settings)
        scheduler = Scheduler(settings.workers, recorder, cluster, 0 if cluster else settings.warm_workers)
        return cls(
            settings=settings,
            access=access_for(settings.host, token, settings.allowed_hosts, secure=settings.tls_cert is not None),
            kernels=Kernels(settings.compile_forms),
            storage=storage,
            events=events,
            jobs=JobService(recorder, storage, scheduler, settings.jobs_per_client, settings.queue_length),
            postures=LatestFirstLimiter(1, settings.posture_waiting, "posture"),
            runs=LatestFirstLimiter(settings.interactive_slots, settings.interactive_waiting, "run"),
            voices=VoiceHost(settings.live_voices),
            gestures=LruCache(GESTURES_KEPT),
        )

    def start(self) -> None:
        """To be called in the event loop that answers. Raises what ``Storage.open`` raises."""
        self.storage.open()
        self.events.bind()
        self.kernels.start(then=self.jobs.scheduler.warm_up)
        self.storage.retention.start()
        self.jobs.scheduler.start()
        self.jobs.resume()

    def close(self) -> None:
        """End streams, runs and worker processes."""
        self.events.close()
        self.kernels.close()
        self.jobs.scheduler.close()
        self.voices.close()
        self.storage.close()


def _cluster(settings: Settings) -> DaskCluster | None:
    if settings.dask_scheduler_address is None:
        return None
    return DaskCluster(settings.dask_scheduler_address, settings.cluster_in_flight)


async def services(connection: HTTPConnection) -> Services:
    """Dependency: the services of this application; async, because FastAPI calls other dependencies in a thread."""
    return connection.app.state.services


Shared = Annotated[Services, Depends(services)]
Client = Annotated[str, Depends(client_of)]
