"""One file per group of calls of /api/v1, and the page."""
