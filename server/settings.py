"""Settings of the operator: environment variables ``VOCALIS_*``, checked when the server starts."""

import os
from pathlib import Path
from typing import Annotated

from pydantic import AliasChoices, Field, SecretStr, field_validator, model_validator
from pydantic_settings import BaseSettings, NoDecode, SettingsConfigDict


class Settings(BaseSettings):
    """Every limit that an error message names is a field here."""

    model_config = SettingsConfigDict(env_prefix="VOCALIS_", extra="ignore", env_ignore_empty=True)

    host: str = "127.0.0.1"
    port: int = Field(default=8000, ge=0, le=65535)
    token: SecretStr | None = Field(
        default=None,
        description="long and random; needed for every request when set, generated when the host is public",
    )
    allowed_hosts: Annotated[tuple[str, ...], NoDecode] = Field(
        default=(), description="further names a browser may use"
    )
    tls_cert: str | None = None
    tls_key: str | None = None

    workers: int = Field(default=os.cpu_count() or 1, ge=1, le=256, description="niced processes for jobs")
    warm_workers: int = Field(
        default=min(2, os.cpu_count() or 1), ge=0, le=256, description="of these, how many start before there is a job"
    )
    dask_scheduler_address: str | None = Field(
        default=None, validation_alias=AliasChoices("VOCALIS_DASK_SCHEDULER_ADDRESS", "DASK_SCHEDULER_ADDRESS"),
        description="where sweeps are computed instead of in this machine's processes",
    )  # fmt: skip
    cluster_in_flight: int = Field(default=256, ge=1, le=4096, description="tasks at a time on the cluster")
    jobs_directory: Path | None = Field(default=None, description="where jobs and results are kept; VOCALIS_DATA/jobs")
    interactive_slots: int = Field(
        default=min(2, os.cpu_count() or 1), ge=1, le=64, description="runs at a time in the server"
    )
    interactive_waiting: int = Field(default=16, ge=1, le=1000, description="runs that may wait for a slot")
    posture_waiting: int = Field(default=128, ge=1, le=10_000, description="postures that may wait, of some ms each")
    gesture_duration_s: float = Field(default=30.0, gt=0, description="longest gesture rendered while the client waits")
    compile_forms: bool = Field(
        default=True, description="after the start, compile ahead what two folds, lesions and the human variant need"
    )
    live_voices: int = Field(default=8, ge=0, le=256, description="voices played at a time")

    body_bytes: int = Field(default=1_048_576, ge=1024, description="largest request body")
    simulate_duration_s: float = Field(default=2.0, gt=0, description="longest synchronous run, simulated")
    simulate_node_steps: float = Field(
        default=3e8, gt=0, description="nx·ny·steps of a synchronous run, about 2 s of work"
    )
    job_node_steps: float = Field(default=5e10, gt=0, description="nx·ny·steps of a job, about 5 min of work")
    sweep_points: int = Field(default=100_000, ge=1, description="points of one sweep")
    sweep_node_steps: float = Field(
        default=1e13, gt=0, description="nx·ny·steps of a sweep, about a night on two cores"
    )
    queue_length: int = Field(default=100, ge=1, description="waiting jobs of all clients")
    jobs_per_client: int = Field(default=20, ge=1, description="unfinished jobs of one client")
    jobs_kept: int = Field(default=2000, ge=10, description="finished jobs kept, of all clients")
    keep_days: float = Field(default=90, gt=0, description="days to keep finished jobs and unused results")
    stored_bytes: int = Field(
        default=4 * 2**30, ge=2**20, description="disk for results; the least recently used go first"
    )
    points_kept: int = Field(
        default=3_000_000, ge=1000, description="sweep points kept, about 0.5 kB each; the oldest go first"
    )
    streams_per_client: int = Field(default=8, ge=1, description="event streams open at a time")
    result_bytes: int = Field(
        default=512 * 2**20, ge=2**20, description="memory for results; the least recently used go first"
    )

    @model_validator(mode="after")
    def _certificate_and_key(self) -> "Settings":
        if (self.tls_cert is None) != (self.tls_key is None):
            raise ValueError("tls_cert and tls_key go together")
        return self

    @field_validator("allowed_hosts", mode="before")
    @classmethod
    def _split(cls, value):
        return tuple(part.strip() for part in value.split(",") if part.strip()) if isinstance(value, str) else value
