"""A voice whose parameters move: breakpoints in time, the fold that follows them, sound without seams, contours."""
