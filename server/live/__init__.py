"""Voices that are played: a process of their own that makes sound block by block, and the way to it."""
