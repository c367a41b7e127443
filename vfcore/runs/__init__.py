"""One run, many runs, sweeps and gestures."""
