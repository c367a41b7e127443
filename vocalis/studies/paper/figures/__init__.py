"""The paper's figures, computed for the page."""
