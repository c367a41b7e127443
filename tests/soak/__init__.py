"""Load and violence: scripts that take minutes, and short versions of them in the normal suite."""
