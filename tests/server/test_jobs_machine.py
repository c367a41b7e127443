"""Whatever clients, workers and restarts do in whatever order: no job is lost, and none moves against the table."""

import shutil
import tempfile
from pathlib import Path

import numpy as np
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import Bundle, RuleBasedStateMachine, initialize, invariant, multiple, rule

import vfcore
from tests.server.jobs_harness import JobSystem
from vfcore.errors import ParameterError
from vfcore.runs.sweep import sweep_from_dict, sweep_to_dict
from vfcore.runs.sweep.row import Row, columns
from vfcore.spec.address import Computation
from vfcore.spec.request import document_of, resolve
from vocalis.server.exceptions import NoSuchJob
from vocalis.server.jobs.kinds.sweep import SWEEP
from vocalis.server.jobs.kinds.sweep.work import SweepWork
from vocalis.server.jobs.model import ACTIVE, TRANSITIONS, Status

RUNS = [document_of(resolve({"vowel": vowel, "run": {"duration_s": 0.02}})) for vowel in "ai"]
SWEEPS = [
    sweep_to_dict(sweep_from_dict({"axes": [{"parameter": "activation.ct", "values": [k / 10 for k in values]}]}))
    for values in (range(3), range(1, 5))  # they share two points
]
RESULT = vfcore.simulate(resolve(RUNS[0]))
PROBLEM = {"type": "urn:test", "title": "t", "status": 422, "detail": "d"}


def row_of(computation: Computation) -> Row:
    """A row that tells which point it is of."""
    width = len(columns(sweep_from_dict(SWEEPS[0])))
    return Row("periodic", np.full(width, computation.own.settings["activation.ct"]), {}, None)


class Jobs(RuleBasedStateMachine):
    handles = Bundle("handles")

    @initialize()
    def open(self):
        self.place = Path(tempfile.mkdtemp(prefix="vocalis-machine-"))
        self.system = JobSystem(self.place / "jobs")
        self.known: dict[str, tuple[str, Status]] = {}  # id -> client, last status seen
        self.keys: dict[tuple[str, str], tuple[str, dict]] = {}
        self.computed: set[str] = set()

    def teardown(self):
        self.system.close()
        shutil.rmtree(self.place)

    @rule(
        target=handles, client=st.sampled_from("AB"), request=st.sampled_from(RUNS + SWEEPS), fresh=st.booleans(),
        key=st.sampled_from([None, "k1", "k2"]),
    )  # fmt: skip
    def submit(self, client, request, fresh, key):
        used = self.keys.get((client, key))
        try:
            job = self.system.jobs.submit(client, request, fresh, key)
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
        once = self.system.jobs.dismiss(job_id)
        assert once.status is Status.DISMISSED
        assert self.system.jobs.dismiss(job_id) == once
        still = self.system.storage.jobs.handles(once.work_id)
        assert (once.work_id in self.system.scheduler.work) == bool(still), "work goes on while a job waits"

    @rule(data=st.data(), end=st.sampled_from(["finished", "failed", "retried", "progress"]))
    def work_on_a_run(self, data, end):
        runs = [work for work in self.system.scheduler.work.values() if not isinstance(work, SweepWork)]
        if not runs:
            return
        work = data.draw(st.sampled_from(runs))
        recorder = self.system.recorder
        recorder.started(work.id)
        if end == "progress":
            recorder.progressed(work.id, 0.5)
            recorder.retried(work.id)
        elif end == "retried":
            recorder.retried(work.id)
        else:
            self.finish(work) if end == "finished" else recorder.failed(work.id, PROBLEM)
            del self.system.scheduler.work[work.id]

    def finish(self, work):
        (content,) = work.call.addresses
        self.system.recorder.finished(work.id, lambda: self.system.storage.results.store(content, RESULT))

    @rule(data=st.data(), dies=st.booleans())
    def work_on_a_sweep(self, data, dies):
        sweeps = [work for work in self.system.scheduler.work.values() if isinstance(work, SweepWork)]
        if not sweeps:
            return
        work = data.draw(st.sampled_from(sweeps))
        work.portions.next_size = lambda left: 2
        task = work.next_task()
        if task is not None:
            if not work.fresh:
                assert not self.computed & set(task.addresses), "what is stored is not computed again"
            if dies and len(task.positions) == 1:
                work.gave_up(task, "its worker died")
            else:
                work.computed(task, [row_of(work.sweep.computation(k)) for k in task.positions])
                self.computed |= set(task.addresses)
            task.close()
        if work.is_complete:
            work.finish()
            del self.system.scheduler.work[work.id]

    @rule()
    def restart(self):
        self.system.close()
        self.system = JobSystem(self.place / "jobs")

    @rule()
    def tidy(self):
        self.system.storage.retention.tidy()

    @invariant()
    def every_job_is_there_and_moved_along_the_table(self):
        for job_id, (client, before) in self.known.items():
            job = self.system.jobs.job(job_id)
            assert job.client == client and 0 <= job.n_failed <= job.n_done <= job.n_total or job.kind == "simulation"
            assert job.status is before or reachable(before, job.status), f"{before} became {job.status}"
            assert (job.finished is not None) == (job.status not in ACTIVE)
            self.known[job_id] = (client, job.status)

    @invariant()
    def every_unfinished_job_has_work_and_every_work_a_job_that_waits(self):
        assert {job.work_id for job in self.system.storage.jobs.active()} == set(self.system.scheduler.work)

    @invariant()
    def lists_are_complete_and_newest_first(self):
        for client in "AB":
            listed, more = self.system.jobs.jobs(client, None, None, 1000, None)
            assert not more
            assert {job.id for job in listed} == {
                job_id for job_id, (owner, _) in self.known.items() if owner == client
            }
            assert [job.sequence for job in listed] == sorted((job.sequence for job in listed), reverse=True)

    @invariant()
    def a_successful_sweep_has_all_its_numbers(self):
        for job_id in self.known:
            job = self.system.jobs.job(job_id)
            if job.kind == "sweep" and job.status is Status.SUCCESSFUL:
                table = SWEEP.load(job, self.system.storage)
                assert table.n_done == job.n_total and table.n_failed == job.n_failed
                there = np.isfinite(table.measure("fo_hz"))
                assert (table.measure("fo_hz")[there] == np.array(table.sweep.axes[0].values)[there]).all()

    @invariant()
    def an_unknown_job_is_refused(self):
        try:
            self.system.jobs.job("../jobs")
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
