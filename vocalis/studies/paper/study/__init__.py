"""The designed study of what the paper leaves open."""
