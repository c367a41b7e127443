"""How fast Vocalis is on this machine; installed as ``vocalis_bench`` and run by ``vocalis bench``."""
