"""Load and crash tests: scripts that take minutes, and short versions for the normal suite."""
