"""What an operator may set: environment variables ``VOCALIS_*``, checked when the server starts."""

import os
from pathlib import Path
from typing import Annotated

from pydantic import AliasChoices, Field, SecretStr, field_validator, model_validator
from pydantic_settings import BaseSettings, NoDecode, SettingsConfigDict


class Settings(BaseSettings):
    """Every limit a refusal can name is a field here."""

    model_config = SettingsConfigDict(env_prefix="VOCALIS_", extra="ignore", env_ignore_empty=True)

    host: str = "127.0.0.1"
    port: int = Field(8000, ge=0, le=65535)
    token: SecretStr | None = Field(
        None, description="long and random; asked of everybody when set, made up when the host is public"
    )
    allowed_hosts: Annotated[tuple[str, ...], NoDecode] = Field((), description="further names a browser may use")
    tls_cert: str | None = None
    tls_key: str | None = None

    workers: int = Field(os.cpu_count() or 1, ge=1, le=256, description="niced processes for jobs")
    warm_workers: int = Field(
        min(2, os.cpu_count() or 1), ge=0, le=256, description="of these, how many start before there is a job"
    )
    dask_scheduler_address: str | None = Field(
        None, validation_alias=AliasChoices("VOCALIS_DASK_SCHEDULER_ADDRESS", "DASK_SCHEDULER_ADDRESS"),
        description="where sweeps are computed instead of in this machine's processes",
    )  # fmt: skip
    cluster_in_flight: int = Field(256, ge=1, le=4096, description="tasks at a time on the cluster")
    jobs_directory: Path | None = Field(None, description="where jobs and results are kept; VOCALIS_DATA/jobs")
    interactive_slots: int = Field(min(2, os.cpu_count() or 1), ge=1, le=64, description="runs at a time in the server")
    interactive_waiting: int = Field(16, ge=1, le=1000, description="runs that may wait for a slot")
    posture_waiting: int = Field(128, ge=1, le=10_000, description="postures that may wait, of some ms each")
    gesture_duration_s: float = Field(30.0, gt=0, description="longest gesture rendered while the client waits")
    live_voices: int = Field(8, ge=0, le=256, description="voices played at a time")

    body_bytes: int = Field(1_048_576, ge=1024, description="largest request body")
    simulate_duration_s: float = Field(2.0, gt=0, description="longest synchronous run, simulated")
    simulate_node_steps: float = Field(3e8, gt=0, description="nx·ny·steps of a synchronous run, about 2 s of work")
    job_node_steps: float = Field(5e10, gt=0, description="nx·ny·steps of a job, about 5 min of work")
    sweep_points: int = Field(100_000, ge=1, description="points of one sweep")
    sweep_node_steps: float = Field(1e13, gt=0, description="nx·ny·steps of a sweep, about a night on two cores")
    queue_length: int = Field(100, ge=1, description="jobs waiting, all clients together")
    jobs_per_client: int = Field(20, ge=1, description="unfinished jobs of one client")
    jobs_kept: int = Field(2000, ge=10, description="finished jobs remembered, all clients together")
    keep_days: float = Field(90, gt=0, description="how long finished jobs and what nobody asked for is kept")
    stored_bytes: int = Field(4 * 2**30, ge=2**20, description="disk for results; the least recently used go first")
    points_kept: int = Field(3_000_000, ge=1000, description="sweep points kept, some 0.5 kB each; oldest go first")
    streams_per_client: int = Field(8, ge=1, description="event streams open at a time")
    result_bytes: int = Field(512 * 2**20, ge=2**20, description="memory for results; the least recently used go first")

    @model_validator(mode="after")
    def _certificate_and_key(self) -> "Settings":
        if (self.tls_cert is None) != (self.tls_key is None):
            raise ValueError("tls_cert and tls_key go together")
        return self

    @field_validator("allowed_hosts", mode="before")
    @classmethod
    def _split(cls, value):
        return tuple(part.strip() for part in value.split(",") if part.strip()) if isinstance(value, str) else value
