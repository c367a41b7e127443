"""Requests and answers at the wire."""
