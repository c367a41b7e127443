"""The paper's claims, by the part of the paper that makes them."""
