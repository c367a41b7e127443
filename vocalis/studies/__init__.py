"""Studies made with the core: the paper's claims, and published norms of men."""
