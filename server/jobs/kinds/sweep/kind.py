"""The kind of job that is a sweep."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import orjson

from vfcore.runs.sweep.cost import check_cost
from vfcore.runs.sweep.document import sweep_from_dict, sweep_to_dict
from vfcore.runs.sweep.plan import Sweep
from vfcore.runs.sweep.row import columns
from vfcore.runs.sweep.table import SweepTable
from vocalis.server.jobs.kinds.base import CSV, FILES, JSON, NETCDF, RESULT, Answer, JobKind
from vocalis.server.jobs.kinds.sweep.work import SweepWork, is_kept
from vocalis.server.jobs.model import Job, Status
from vocalis.server.jobs.work import WorkListener
from vocalis.server.schemas.answers import SweepResult
from vocalis.server.schemas.sweeps import SweepBody, sweep_of

if TYPE_CHECKING:
    from vocalis.server.jobs.storage import Storage
    from vocalis.server.settings import Settings

LONGEST_LIST = 100  # entries of a request that lists and events repeat


class SweepKind(JobKind[Sweep]):
    """A sweep over axes or points. Its answer is the table of its points, which the point store keeps."""

    name = "sweep"
    body = SweepBody
    answer_model = SweepResult
    forms = RESULT | FILES

    def read(self, body: Any) -> Sweep:
        return sweep_of(body)

    def parse(self, document: dict[str, Any]) -> Sweep:
        return sweep_from_dict(document)

    def canonical(self, wanted: Sweep) -> dict[str, Any]:
        return sweep_to_dict(wanted)

    def address(self, wanted: Sweep) -> str:
        return wanted.content

    def n_total(self, wanted: Sweep) -> int:
        return len(wanted)

    def check_cost(self, wanted: Sweep, settings: "Settings") -> None:
        limits = settings.sweep_points, settings.sweep_node_steps
        check_cost(wanted, *limits, "VOCALIS_SWEEP_POINTS", "VOCALIS_SWEEP_NODE_STEPS")

    def work(self, job: Job, storage: "Storage", listener: WorkListener) -> SweepWork:
        return SweepWork(job.work_id, self.parse(job.request), storage, listener, job.fresh)

    def has_answer(self, wanted: Sweep, storage: "Storage") -> bool:
        return self._finished(wanted, storage) is not None

    def take_answer(self, job: Job, storage: "Storage") -> bool:
        """Points belong to work, so the new job takes over the work of the finished one."""
        if (done := self._finished(self.parse(job.request), storage)) is None:
            return False
        job.work_id, job.n_failed = done.work_id, done.n_failed
        return True

    def _finished(self, sweep: Sweep, storage: "Storage") -> Job | None:
        """The newest finished job of a sweep; None also where whole results that it was to keep are gone."""
        done = storage.jobs.latest(sweep.content, (Status.SUCCESSFUL,))
        if done is None or not sweep.keep_waveforms:
            return done
        rows = storage.points.rows(done.work_id, len(columns(sweep)))
        return done if all(is_kept(sweep, place, row.state is None, storage.results) for place, row in rows) else None

    def brief(self, request: dict[str, Any]) -> dict[str, Any]:
        """Lists of more than LONGEST_LIST entries are null; GET of the job itself has them."""
        short = dict(request)
        if len(short.get("points") or ()) > LONGEST_LIST:
            short["points"] = None
        if short.get("axes"):
            short["axes"] = [
                axis | {"values": axis["values"] if len(axis["values"]) <= LONGEST_LIST else None}
                for axis in short["axes"]
            ]
        return short

    def load(self, job: Job, storage: "Storage", partial: bool = False) -> SweepTable:
        """The table of a finished sweep, or with ``partial`` the points so far; NotFinished, ResultGone."""
        table = SweepTable(self.checked(job, partial))
        return table.fill(storage.points.rows(job.work_id, len(table.columns)))

    def result(
        self, job: Job, storage: "Storage", measures: Sequence[str] | None = None, partial: bool = False
    ) -> Answer:
        document = self.load(job, storage, partial).document(measures)
        # Thousands of numbers, none of them NaN; the standard library would write them one by one.
        return Answer(orjson.dumps(document), JSON)

    def netcdf(self, job: Job, storage: "Storage", partial: bool = False) -> Answer:
        from vfcore.runs.sweep.files import netcdf_bytes  # its library would slow down every start of the server

        return Answer(netcdf_bytes(self.load(job, storage, partial)), NETCDF)

    def csv(self, job: Job, storage: "Storage", partial: bool = False) -> Answer:
        from vfcore.runs.sweep.files import csv_lines  # as above

        return Answer(csv_lines(self.load(job, storage, partial)), CSV)
