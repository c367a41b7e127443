"""How far the paper's grid and step are from fine ones."""
