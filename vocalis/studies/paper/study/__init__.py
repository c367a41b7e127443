"""The designed study of the choices that the paper leaves open."""
