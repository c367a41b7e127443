"""Whatever clients, workers and restarts do in whatever order: no job is lost, and none moves against the table."""

import shutil
import tempfile
from pathlib import Path

import numpy as np
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import Bundle, RuleBasedStateMachine, initialize, invariant, multiple, rule

import vfcore
from tests.server.desk_harness import Shop
from vfcore.errors import ParameterError
from vfcore.runs.sweep import sweep_from_dict, sweep_to_dict
from vfcore.runs.sweep.row import Row, columns
from vfcore.spec.request import document_of, resolve
from vocalis.server.jobs.model import ACTIVE, TRANSITIONS, NoSuchJob, Status
from vocalis.server.jobs.sweep_work import SweepWork

RUNS = [document_of(resolve({"vowel": vowel, "run": {"duration_s": 0.02}})) for vowel in "ai"]
SWEEPS = [
    sweep_to_dict(sweep_from_dict({"axes": [{"parameter": "activation.ct", "values": [k / 10 for k in values]}]}))
    for values in (range(3), range(1, 5))  # they share two points
]
RESULT = vfcore.simulate(resolve(RUNS[0]))
PROBLEM = {"type": "urn:test", "title": "t", "status": 422, "detail": "d"}


def row_of(document: dict) -> Row:
    """A row that tells which point it is of."""
    width = len(columns(sweep_from_dict(SWEEPS[0])))
    return Row("periodic", np.full(width, document["activation"]["ct"]), {}, None)


class Jobs(RuleBasedStateMachine):
    handles = Bundle("handles")

    @initialize()
    def open(self):
        self.place = Path(tempfile.mkdtemp(prefix="vocalis-machine-"))
        self.shop = Shop(self.place / "jobs")
        self.known: dict[str, tuple[str, Status]] = {}  # id -> client, last status seen
        self.keys: dict[tuple[str, str], tuple[str, dict]] = {}
        self.computed: set[str] = set()

    def teardown(self):
        self.shop.close()
        shutil.rmtree(self.place)

    @rule(
        target=handles, client=st.sampled_from("AB"), request=st.sampled_from(RUNS + SWEEPS), fresh=st.booleans(),
        key=st.sampled_from([None, "k1", "k2"]),
    )  # fmt: skip
    def submit(self, client, request, fresh, key):
        n_total = len(sweep_from_dict(request)) if request["kind"] == "sweep" else 1
        used = self.keys.get((client, key))
        try:
            job = self.shop.desk.submit(client, request, fresh, key, n_total)
        except ParameterError:
            assert used and used[1] != request, "only a key that was used for something else is refused"
            return multiple()
        if used:
            assert job.id == used[0], "the same key is the same job, also after a restart"
        elif key is not None:
            self.keys[client, key] = (job.id, request)
        assert job.client == client and job.request == request
        self.known.setdefault(job.id, (client, job.status))
        return job.id

    @rule(job_id=handles)
    def dismiss(self, job_id):
        once = self.shop.desk.dismiss(job_id)
        assert once.status is Status.DISMISSED
        assert self.shop.desk.dismiss(job_id) == once
        still = self.shop.store.handles(once.work_id)
        assert (once.work_id in self.shop.engine.work) == bool(still), "work goes on exactly as long as somebody waits"

    @rule(data=st.data(), end=st.sampled_from(["finished", "failed", "retried", "progress"]))
    def work_on_a_run(self, data, end):
        runs = [work for work in self.shop.engine.work.values() if not isinstance(work, SweepWork)]
        if not runs:
            return
        work = data.draw(st.sampled_from(runs))
        ledger = self.shop.ledger
        ledger.started(work.id)
        if end == "progress":
            ledger.progressed(work.id, 0.5)
            ledger.retried(work.id)
        elif end == "retried":
            ledger.retried(work.id)
        else:
            ledger.finished(work.id, RESULT) if end == "finished" else ledger.failed(work.id, PROBLEM)
            del self.shop.engine.work[work.id]

    @rule(data=st.data(), dies=st.booleans())
    def work_on_a_sweep(self, data, dies):
        sweeps = [work for work in self.shop.engine.work.values() if isinstance(work, SweepWork)]
        if not sweeps:
            return
        work = data.draw(st.sampled_from(sweeps))
        if not work.begun:
            work.begun = True
            self.shop.ledger.started(work.id)
        work.portions.next_size = lambda left: 2
        task = work.next_task(self.shop.points, self.shop.ledger, self.shop.engine.in_flight)
        if task is not None:
            if not work.fresh:
                assert not self.computed & set(task.addresses), "what is stored is not handed out again"
            if dies and len(task.positions) == 1:
                self.shop.ledger.gave_up(task, "its worker died")
            else:
                self.shop.ledger.computed(task, [row_of(work.sweep.computation(k)) for k in task.positions])
                self.computed |= set(task.addresses)
            self.shop.engine.in_flight.release(task.addresses)
        if work.is_complete:
            self.shop.ledger.finished(work.id, None)
            del self.shop.engine.work[work.id]

    @rule()
    def restart(self):
        self.shop.close()
        self.shop = Shop(self.place / "jobs")

    @rule()
    def tidy(self):
        self.shop.retention.tidy()

    @invariant()
    def every_job_is_there_and_moved_along_the_table(self):
        for job_id, (client, before) in self.known.items():
            job = self.shop.desk.job(job_id)
            assert job.client == client and 0 <= job.n_failed <= job.n_done <= job.n_total or job.kind == "simulation"
            assert job.status is before or reachable(before, job.status), f"{before} became {job.status}"
            assert (job.finished is not None) == (job.status not in ACTIVE)
            self.known[job_id] = (client, job.status)

    @invariant()
    def every_unfinished_job_has_work_and_every_work_somebody_who_waits(self):
        assert {job.work_id for job in self.shop.store.active()} == set(self.shop.engine.work)

    @invariant()
    def lists_are_complete_and_newest_first(self):
        for client in "AB":
            listed, more = self.shop.desk.jobs(client, None, None, 1000, None)
            assert not more
            assert {job.id for job in listed} == {
                job_id for job_id, (owner, _) in self.known.items() if owner == client
            }
            assert [job.sequence for job in listed] == sorted((job.sequence for job in listed), reverse=True)

    @invariant()
    def a_successful_sweep_has_all_its_numbers(self):
        for job_id in self.known:
            job = self.shop.desk.job(job_id)
            if job.kind == "sweep" and job.status is Status.SUCCESSFUL:
                table = self.shop.desk.table(job)
                assert table.n_done == job.n_total and table.n_failed == job.n_failed
                there = np.isfinite(table.measure("fo_hz"))
                assert (table.measure("fo_hz")[there] == np.array(table.sweep.axes[0].values)[there]).all()

    @invariant()
    def an_unknown_job_is_told_as_such(self):
        try:
            self.shop.desk.job("../jobs")
        except NoSuchJob:
            return
        raise AssertionError


def reachable(start: Status, end: Status) -> bool:
    seen, front = {start}, [start]
    while front:
        for other in TRANSITIONS[front.pop()] - seen:
            seen.add(other)
            front.append(other)
    return end in seen


TestJobs = Jobs.TestCase
TestJobs.settings = settings(
    max_examples=25, stateful_step_count=25, deadline=None, suppress_health_check=list(HealthCheck), derandomize=True
)
