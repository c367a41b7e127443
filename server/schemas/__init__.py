"""The schemas of requests and answers at the wire."""
