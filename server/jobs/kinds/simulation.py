"""Simulations: one run, kept whole, with measures, arrays and sound."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from vfcore.errors import ParameterError
from vfcore.io.audio import render, to_wav_bytes
from vfcore.io.csv import csv_text
from vfcore.io.result_document import result_document
from vfcore.io.stored import load_result, save_result
from vfcore.runs.result import ARRAYS, SimulationResult, dims_of
from vfcore.spec.address import address
from vfcore.spec.request import document_of, resolve
from vfcore.spec.simulation import Simulation
from vocalis.server.encoding import array_of, float32_bytes
from vocalis.server.jobs.computations import run_simulation
from vocalis.server.jobs.cost import check_cost
from vocalis.server.jobs.kinds.base import BYTES, CSV, FILES, NETCDF, RESULT, WAV, WAVEFORMS, Answer, Part, SingleKind
from vocalis.server.jobs.kinds.registry import register
from vocalis.server.jobs.model import Job, Status
from vocalis.server.schemas.answers import Result
from vocalis.server.schemas.requests import JobBody, simulation_of

if TYPE_CHECKING:
    from vocalis.server.jobs.storage import Storage
    from vocalis.server.settings import Settings


class SimulationFormat:
    """Results of runs as zips of arrays."""

    result_type: type[Any] = SimulationResult
    ending = ".npz"

    def save(self, result: SimulationResult, path: Path) -> int:
        return save_result(result, path)

    def load(self, path: Path) -> SimulationResult:
        return load_result(path)

    def size_bytes(self, result: SimulationResult) -> int:
        return sum(array.nbytes for array in result.arrays.values())

    def address(self, result: SimulationResult) -> str:
        return address(result.request)


class SimulationKind(SingleKind[Simulation, SimulationResult]):
    """One simulation in a worker process."""

    name = "simulation"
    body = JobBody
    answer_model = Result
    forms = RESULT | FILES | WAVEFORMS
    format = SimulationFormat()
    function = staticmethod(run_simulation)
    check_needs_kernels = True

    def read(self, body: Any) -> Simulation:
        return simulation_of(body)

    def parse(self, document: dict[str, Any]) -> Simulation:
        return resolve(document)

    def canonical(self, wanted: Simulation) -> dict[str, Any]:
        return document_of(wanted)

    def address(self, wanted: Simulation) -> str:
        return address(wanted)

    def check_cost(self, wanted: Simulation, settings: "Settings") -> None:
        check_cost(wanted, settings.job_node_steps, "VOCALIS_JOB_NODE_STEPS")

    def job_of_result(self, content: str, storage: "Storage") -> Job | None:
        result = storage.results.get(content)
        if not isinstance(result, SimulationResult):
            return None
        made = result.provenance.created
        return Job(
            content, "", self.name, document_of(result.request), content, content, made,
            status=Status.SUCCESSFUL, progress=1.0, n_done=1, started=made, finished=made,
        )  # fmt: skip

    def load(self, job: Job, storage: "Storage") -> SimulationResult:
        return replace(super().load(job, storage), request=self.parse(job.request))  # its own words, same computation

    def document(self, result: SimulationResult) -> dict[str, Any]:
        return result_document(result)

    def netcdf(self, job: Job, storage: "Storage", partial: bool = False) -> Answer:
        from vfcore.io.netcdf import netcdf_bytes  # its library would slow down every start of the server

        return Answer(netcdf_bytes(self.load(job, storage)), NETCDF)

    def csv(self, job: Job, storage: "Storage", partial: bool = False) -> Answer:
        return Answer(csv_text(self.load(job, storage)).encode(), CSV)

    def array(self, job: Job, storage: "Storage", name: str, part: Part = Part()) -> Answer:  # noqa: B008 - a value
        result = self.load(job, storage)
        whole = array_of(result, name, "name")
        dims, length = dims_of(name, whole), len(whole)
        stop = length if part.stop is None else part.stop
        for path, value, most in (("stop", stop, length), ("start", part.start, stop)):
            if value > most:
                raise ParameterError(path, f"{value} is beyond the end", f"0 to {most}")
        chosen = whole[part.start : stop : part.stride]
        headers = {"X-Shape": ",".join(map(str, chosen.shape)), "X-Dims": ",".join(dims), "X-Unit": ARRAYS[name].unit}
        if dims[0] == "time":
            headers["X-Sample-Rate-Hz"] = repr(result.provenance.sample_rate_hz / part.stride)
        return Answer(float32_bytes(chosen), BYTES, headers)

    def audio(self, job: Job, storage: "Storage", normalize: bool = True) -> Answer:
        result = self.load(job, storage)
        sound = render(result.arrays["radiated_pressure_pa"], result.provenance.sample_rate_hz)
        content, gain = to_wav_bytes(sound, normalize, phonating=result.report.state != "none")
        return Answer(content, WAV, {"X-Gain": repr(gain)})


SIMULATION = SimulationKind()
register(SIMULATION)
