"""The tables on disk: jobs, the keys they were submitted with, scalars of sweep points, and the files of results."""

from sqlalchemy import (
    JSON,
    Boolean,
    Column,
    Float,
    Index,
    Integer,
    LargeBinary,
    MetaData,
    String,
    Table,
    UniqueConstraint,
)

METADATA = MetaData()
#: To be raised when a table changes; a folder with another layout is not read.
LAYOUT = 1

JOBS = Table(
    "jobs",
    METADATA,
    Column("sequence", Integer, primary_key=True, autoincrement=True),
    Column("id", String, nullable=False, unique=True),
    Column("client", String, nullable=False),
    Column("kind", String, nullable=False),
    Column("request", JSON, nullable=False),
    Column("content", String, nullable=False),
    Column("work_id", String, nullable=False),
    Column("created", String, nullable=False),
    Column("status", String, nullable=False),
    Column("progress", Float, nullable=False),
    Column("n_done", Integer, nullable=False),
    Column("n_total", Integer, nullable=False),
    Column("n_failed", Integer, nullable=False),
    Column("fresh", Boolean, nullable=False),
    Column("started", String),
    Column("finished", String),
    Column("problem", JSON(none_as_null=True)),
    Index("jobs_of_client", "client", "sequence"),
    Index("jobs_of_content", "content", "sequence"),
    Index("jobs_by_status", "status"),
    Index("jobs_of_work", "work_id"),
    sqlite_autoincrement=True,
)
KEYS = Table(
    "keys",
    METADATA,
    Column("client", String, primary_key=True),
    Column("key", String, primary_key=True),
    Column("content", String, nullable=False),
    Column("job_id", String, nullable=False, index=True),
)
#: ``row`` is what vfcore.runs.sweep.row.encode makes; ``times`` how often it was computed, which is once.
POINTS = Table(
    "points",
    METADATA,
    Column("number", Integer, primary_key=True),
    Column("address", LargeBinary, nullable=False),
    Column("state", String),
    Column("row", LargeBinary, nullable=False),
    Column("times", Integer, nullable=False),
    UniqueConstraint("address"),
)
#: Which points a sweep has: by ``number``, or with a ``problem`` of its own where no worker could answer.
MEMBERS = Table(
    "members",
    METADATA,
    Column("work_id", String, primary_key=True),
    Column("position", Integer, primary_key=True),
    Column("number", Integer, index=True),
    Column("problem", String),
    sqlite_with_rowid=False,
)
RESULTS = Table(
    "results",
    METADATA,
    Column("content", String, primary_key=True),
    Column("bytes", Integer, nullable=False),
    Column("used", Float, nullable=False, index=True),
)
