"""The command line of Vocalis; the command `vocalis` is ``vocalis.cli.main:run``."""
