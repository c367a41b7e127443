"""Convergence of the paper's grid and time step."""
