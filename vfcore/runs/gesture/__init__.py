"""Gestures: parameters that move in time, the fold that follows them, continuous sound, contours."""
