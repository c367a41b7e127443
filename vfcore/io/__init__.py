"""Results as documents, files and sound."""
