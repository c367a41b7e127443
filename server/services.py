"""What the routes share, made once per server and handed to them by dependency."""

from dataclasses import dataclass
from typing import Annotated

from fastapi import Depends
from starlette.requests import HTTPConnection

from vocalis_server.access import Access, access_for, client_of
from vocalis_server.gestures import GestureCache
from vocalis_server.jobs.desk import Desk
from vocalis_server.jobs.events import EventLog
from vocalis_server.jobs.interactive import Interactive
from vocalis_server.jobs.results import ResultCache
from vocalis_server.jobs.store import JobStore
from vocalis_server.kernels import Kernels
from vocalis_server.live.host import Host
from vocalis_server.settings import Settings


@dataclass(frozen=True, slots=True)
class Services:
    """One of each. ``postures`` has a thread of its own: a posture takes 2 ms and must not wait for a run."""

    settings: Settings
    access: Access
    kernels: Kernels
    results: ResultCache
    events: EventLog
    desk: Desk
    postures: Interactive
    runs: Interactive
    voices: Host
    gestures: GestureCache

    @classmethod
    def of(cls, settings: Settings) -> "Services":
        token = settings.token.get_secret_value() if settings.token else None
        results, events = ResultCache(settings.result_bytes), EventLog()
        store = JobStore(settings.jobs_kept)
        return cls(
            settings=settings,
            access=access_for(settings.host, token, settings.allowed_hosts, secure=settings.tls_cert is not None),
            kernels=Kernels(),
            results=results,
            events=events,
            desk=Desk(results, events, store, settings.workers, settings.jobs_per_client, settings.queue_length),
            postures=Interactive(1, settings.interactive_waiting, "posture"),
            runs=Interactive(settings.interactive_slots, settings.interactive_waiting, "run"),
            voices=Host(settings.live_voices),
            gestures=GestureCache(),
        )

    def start(self) -> None:
        """To be called in the event loop that answers."""
        self.events.bind()
        self.kernels.start()

    def close(self) -> None:
        """End streams, runs and worker processes."""
        self.events.close()
        self.desk.engine.close()
        self.voices.close()


def services(connection: HTTPConnection) -> Services:
    """Dependency: the services of this application."""
    return connection.app.state.services


Shared = Annotated[Services, Depends(services)]
Client = Annotated[str, Depends(client_of)]
