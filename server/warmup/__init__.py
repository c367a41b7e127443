"""Compiles or loads kernels before the first request needs them."""
