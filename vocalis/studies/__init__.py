"""Studies with the model: the claims of the paper, and published norms of men."""
