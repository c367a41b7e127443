"""What an operator may set: environment variables ``VOCALIS_*``, checked when the server starts."""

import os
from typing import Annotated

from pydantic import Field, SecretStr, field_validator, model_validator
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

    workers: int = Field(max(1, (os.cpu_count() or 1) - 1), ge=1, le=256, description="processes for jobs")
    interactive_slots: int = Field(min(2, os.cpu_count() or 1), ge=1, le=64, description="runs at a time in the server")
    interactive_waiting: int = Field(16, ge=1, le=1000, description="runs that may wait for a slot")
    gesture_duration_s: float = Field(30.0, gt=0, description="longest gesture rendered while the client waits")
    live_voices: int = Field(8, ge=0, le=256, description="voices played at a time")

    body_bytes: int = Field(65_536, ge=1024, description="largest request body")
    simulate_duration_s: float = Field(2.0, gt=0, description="longest synchronous run, simulated")
    simulate_node_steps: float = Field(3e8, gt=0, description="nx·ny·steps of a synchronous run, about 2 s of work")
    job_node_steps: float = Field(5e10, gt=0, description="nx·ny·steps of a job, about 5 min of work")
    queue_length: int = Field(100, ge=1, description="jobs waiting, all clients together")
    jobs_per_client: int = Field(20, ge=1, description="unfinished jobs of one client")
    jobs_kept: int = Field(2000, ge=10, description="finished jobs remembered, all clients together")
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
