"""Sweeps: many points, stored one by one and shared by all sweeps that contain them."""

from vocalis.server.jobs.kinds.registry import register
from vocalis.server.jobs.kinds.sweep.kind import SweepKind

SWEEP = SweepKind()
register(SWEEP)
