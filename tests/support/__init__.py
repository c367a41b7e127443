"""Slow, obvious twins of the compiled physics, for the tests only."""
