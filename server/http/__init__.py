"""What every call passes through: access, safeguards, errors as problems, and the OpenAPI document."""
