"""The fold: assembly, stability bound, static shape, time march."""
