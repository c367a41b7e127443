"""A picture of each claim, as SVG."""
