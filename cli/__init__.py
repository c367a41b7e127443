"""The command line of Vocalis; the command `vocalis` is ``vocalis_cli.main:run``."""
