"""The page of Vocalis: static ES modules served by the server; no build step, nothing from another origin."""
