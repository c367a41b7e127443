"""The fold: assembled, gated, at rest and in motion."""
