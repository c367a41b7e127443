"""Parts of the server by themselves: transitions, the limiter, the event log, imports."""

import asyncio
import subprocess
import sys
import threading

import pytest

from vfcore.runs.one import simulate
from vocalis.server.exceptions import ClientLeft, NotReady, Superseded
from vocalis.server.jobs.events import DONE, PROGRESS, EventLog
from vocalis.server.jobs.model import TRANSITIONS, IllegalTransition, Job, Status
from vocalis.server.limiter import LatestFirstLimiter
from vocalis.server.problems import OTHER, TABLE, kind_of
from vocalis.server.warmup.requests import IRREGULAR, PERIODIC
from vocalis.server.warmup.state import Kernels


def job(status: Status) -> Job:
    return Job("i", "c", "simulation", {}, "content", "work", "now", status=status)


def test_every_arrow_of_the_table_can_be_taken_and_no_other():
    for start in Status:
        for end in Status:
            moved = job(start)
            if end in TRANSITIONS[start]:
                moved.move(end)
                assert moved.status is end
            else:
                with pytest.raises(IllegalTransition):
                    moved.move(end)


def test_what_is_over_never_runs_again():
    for over in (Status.SUCCESSFUL, Status.FAILED, Status.DISMISSED):
        assert TRANSITIONS[over] <= {Status.DISMISSED}
    assert set(TRANSITIONS) == set(Status)


def test_a_class_without_a_row_has_the_row_of_its_base():
    for cls, kind in TABLE.items():
        derived = type("Derived", (cls,), {"__init__": lambda self: None})
        assert kind_of(derived()) is kind
    assert kind_of(RuntimeError()) is OTHER


def in_turn(slots: int, waiting: int, calls: int) -> list:
    """Outcomes of calls that come one after the other while the first one holds the only slot; then their order."""

    async def main():
        gate, release, order = LatestFirstLimiter(slots, waiting, "test"), threading.Event(), []

        def call(number):
            if number == 0:
                release.wait(5)
            order.append(number)
            return number

        tasks = []
        for number in range(calls):
            tasks.append(asyncio.create_task(gate.run(lambda number=number: call(number))))
            await asyncio.sleep(0.01)
        release.set()
        outcomes = await asyncio.gather(*tasks, return_exceptions=True)
        return [order, outcomes]

    return asyncio.run(main())


def test_the_newest_call_is_next():
    order, _ = in_turn(slots=1, waiting=10, calls=4)
    assert order == [0, 3, 2, 1]


def test_the_oldest_waiting_call_is_refused_when_too_many_wait():
    order, outcomes = in_turn(slots=1, waiting=2, calls=4)
    assert order == [0, 3, 2]
    assert isinstance(outcomes[1], Superseded) and "2 places" in str(outcomes[1])


def test_a_call_whose_client_left_is_not_computed_and_its_slot_goes_on():
    async def main():
        gate = LatestFirstLimiter(1, 2, "test")

        async def gone():
            return True

        with pytest.raises(ClientLeft):
            await gate.run(lambda: pytest.fail("computed for nobody"), gone)
        with pytest.raises(ZeroDivisionError):
            await gate.run(lambda: 1 / 0)
        assert await gate.run(lambda: 7) == 7

    asyncio.run(main())


def test_a_cancelled_wait_gives_its_place_back():
    async def main():
        gate, release = LatestFirstLimiter(1, 2, "test"), threading.Event()
        first = asyncio.create_task(gate.run(lambda: release.wait(5)))
        await asyncio.sleep(0.01)
        second = asyncio.create_task(gate.run(lambda: "second"))
        await asyncio.sleep(0.01)
        second.cancel()
        await asyncio.gather(second, return_exceptions=True)
        release.set()
        assert await first and await gate.run(lambda: "third") == "third"

    asyncio.run(main())


def test_the_warm_up_requests_have_the_states_whose_measures_they_compile():
    assert [simulate(request).report.state for request in (PERIODIC, IRREGULAR)] == ["periodic", "irregular"]


def test_calls_wait_for_the_kernels(monkeypatch):
    async def main():
        kernels = Kernels()
        waiting = asyncio.create_task(kernels.for_runs())
        await asyncio.sleep(0.05)
        assert not waiting.done() and not kernels.ready
        kernels.start()
        await waiting
        assert kernels.ready and "ready" in kernels.message

    asyncio.run(main())


def test_calls_get_the_reason_why_there_are_no_kernels(monkeypatch):
    def broken(*_):
        raise OSError("no space left for compiled code")

    monkeypatch.setattr("vocalis.server.warmup.state.simulate", broken)
    kernels = Kernels()
    kernels.compile()
    assert not kernels.ready
    asyncio.run(kernels.for_postures())
    with pytest.raises(NotReady, match="no space left for compiled code"):
        asyncio.run(kernels.for_runs())


def test_the_log_keeps_only_the_latest_progress_of_a_job():
    log = EventLog()
    for k in range(100):
        log.publish(PROGRESS, "me", "a", {"progress": k})
    log.publish(PROGRESS, "me", "b", {"progress": 0})
    log.publish(DONE, "me", "a", {"progress": 100})
    found, _ = log.since(0, "me", None)
    assert [(event.job_id, event.name) for event in found] == [("b", PROGRESS), ("a", DONE)]
    assert log.since(0, "you", None)[0] == []


def test_a_reader_that_missed_too_much_is_not_given_a_gap():
    log = EventLog(kept=3)
    for k in range(5):
        log.publish(DONE, "me", str(k), {})
    events, _ = log.since(0, "me", None)
    assert len(events) == 3
    boot = events[0].id.partition("-")[0]
    assert log.position(f"{boot}-1") is None, "events 2 is gone"
    assert log.position(f"{boot}-2") == 2 and log.position(f"{boot}-5") == 5
    assert log.position(f"{boot}-6") is None and log.position("other-2") is None
    assert log.position(None) is None and log.position("nonsense") is None


def loaded_by(module: str) -> set[str]:
    """The modules that are loaded once this one is imported in a process of its own."""
    code = f"import sys, {module}; print(*sys.modules)"
    return set(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split())


@pytest.mark.parametrize("module", ["problems", "exceptions", "addresses", "encoding"])
def test_what_all_rooms_share_imports_none_of_them(module):
    loaded = loaded_by(f"vocalis.server.{module}")
    rooms = ("http", "jobs", "live", "routes", "schemas", "services", "warmup")
    assert not {name for name in loaded if name.startswith(tuple(f"vocalis.server.{room}" for room in rooms))}


def test_jobs_load_no_web_framework_and_nothing_that_answers_requests():
    loaded = loaded_by("vocalis.server.jobs.service")
    assert not loaded & {"fastapi", "starlette", "uvicorn"}
    assert not {name for name in loaded if name.startswith(("vocalis.server.http", "vocalis.server.routes"))}


def test_a_worker_starts_without_database_and_schemas():
    assert not loaded_by("vocalis.server.jobs.runner") & {"sqlalchemy", "pydantic", "fastapi"}
    assert not loaded_by("vocalis.server.jobs.computations") & {"sqlalchemy", "pydantic", "fastapi"}
