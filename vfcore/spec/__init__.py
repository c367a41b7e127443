"""What a run is asked: validated values in SI units, their document, schema and address."""
