"""The specification of a run: validated values in SI units, their document, schema and address."""
