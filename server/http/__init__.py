"""What every call passes: access, safeguards, and how errors and arrays are answered."""
