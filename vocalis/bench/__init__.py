"""How fast Vocalis is on this machine; installed as ``vocalis.bench`` and run by ``vocalis bench``."""
