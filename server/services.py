"""What the routes share, made once per server and handed to them by dependency."""

from dataclasses import dataclass
from typing import Annotated

from fastapi import Depends
from starlette.requests import HTTPConnection

from vfcore.kernels.jit import data_directory
from vocalis.server.http.access import Access, access_for, client_of
from vocalis.server.jobs.archive import Archive
from vocalis.server.jobs.cluster import DaskCluster
from vocalis.server.jobs.database import Database
from vocalis.server.jobs.events import EventLog
from vocalis.server.jobs.folder import Folder
from vocalis.server.jobs.gesture_cache import GestureCache
from vocalis.server.jobs.interactive import Interactive
from vocalis.server.jobs.points import PointStore
from vocalis.server.jobs.recorder import Ledger
from vocalis.server.jobs.retention import Limits, Retention
from vocalis.server.jobs.scheduler import Engine
from vocalis.server.jobs.service import Desk
from vocalis.server.jobs.store import JobStore
from vocalis.server.live.host import Host
from vocalis.server.settings import Settings
from vocalis.server.warmup.state import Kernels


@dataclass(frozen=True, slots=True)
class Services:
    """One of each. ``postures`` has a thread of its own: a posture takes 2 ms and must not wait for a run."""

    settings: Settings
    access: Access
    kernels: Kernels
    folder: Folder
    database: Database
    store: JobStore
    points: PointStore
    retention: Retention
    archive: Archive
    events: EventLog
    desk: Desk
    postures: Interactive
    runs: Interactive
    voices: Host
    gestures: GestureCache

    @classmethod
    def of(cls, settings: Settings) -> "Services":
        token = settings.token.get_secret_value() if settings.token else None
        folder = Folder(settings.jobs_directory or data_directory() / "jobs")
        database, events = Database(), EventLog()
        store, points = JobStore(database), PointStore(database)
        archive = Archive(database, folder, settings.result_bytes)
        ledger = Ledger(store, points, archive, events)
        cluster = _cluster(settings)
        engine = Engine(settings.workers, ledger, points, cluster, 0 if cluster else settings.warm_workers)
        return cls(
            settings=settings,
            access=access_for(settings.host, token, settings.allowed_hosts, secure=settings.tls_cert is not None),
            kernels=Kernels(),
            folder=folder,
            database=database,
            store=store,
            points=points,
            retention=Retention(database, archive, folder, _limits(settings)),
            archive=archive,
            events=events,
            desk=Desk(ledger, store, points, archive, engine, settings.jobs_per_client, settings.queue_length),
            postures=Interactive(1, settings.posture_waiting, "posture"),
            runs=Interactive(settings.interactive_slots, settings.interactive_waiting, "run"),
            voices=Host(settings.live_voices),
            gestures=GestureCache(),
        )

    def open(self) -> None:
        """Take the folder with the jobs. OSError or StorageUnusable where that cannot be."""
        if self.folder.number == 0:
            self.folder.open()
            self.database.open(self.folder.database)
            self.store.load()
            self.retention.adopt()
            self.retention.tidy()

    def start(self) -> None:
        """To be called in the event loop that answers."""
        self.open()
        self.events.bind()
        self.kernels.start(then=self.desk.engine.warm)
        self.retention.start()
        self.desk.engine.start()
        self.desk.resume()

    def close(self) -> None:
        """End streams, runs and worker processes."""
        self.events.close()
        self.kernels.close()
        self.retention.close()
        self.desk.engine.close()
        self.voices.close()
        self.database.close()
        self.folder.close()


def _cluster(settings: Settings) -> DaskCluster | None:
    if settings.dask_scheduler_address is None:
        return None
    return DaskCluster(settings.dask_scheduler_address, settings.cluster_in_flight)


def _limits(settings: Settings) -> Limits:
    return Limits(settings.jobs_kept, settings.keep_days, settings.stored_bytes, settings.points_kept)


async def services(connection: HTTPConnection) -> Services:
    """Dependency: the services of this application; async, for others are called in a thread."""
    return connection.app.state.services


Shared = Annotated[Services, Depends(services)]
Client = Annotated[str, Depends(client_of)]
