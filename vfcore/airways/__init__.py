"""Trachea and vocal tract: waves, resonances, and the sound of a run."""
