"""A package of this name, so that no other installed one (VocalTractLab's wheel has one) hides it."""
