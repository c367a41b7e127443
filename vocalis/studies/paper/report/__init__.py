"""The scoreboard as HTML and as tables of the documentation."""
