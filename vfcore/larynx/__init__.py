"""Posture of the larynx from muscle activation, and tissue coefficients from posture."""
