"""The `vocalis` command: finds the subcommand, runs it, and turns errors into one line and an exit code.

0 done · 1 the model has no answer (no posture, divergence) · 2 invalid input · 130 interrupted.

Only the requested subcommand is imported: the physics takes a second to load, and `vocalis --help` should not.
"""

import os
import sys
from collections.abc import Sequence
from importlib import import_module, metadata
from typing import Annotated, cast

import typer

from vocalis.cli.texts import COMMANDS, EPILOG, PURPOSE

NO_ANSWER, BAD_INPUT, INTERRUPTED = 1, 2, 130

# The class of "no such option" and the like; its module differs between releases of Typer.
UsageError = cast(type[typer.BadParameter], typer.BadParameter.__base__)


def run() -> None:
    """Entry point of the console script."""
    sys.exit(main(sys.argv[1:]))


def main(arguments: Sequence[str]) -> int:
    """Run one command line and return the exit code."""
    arguments = list(arguments) or ["--help"]
    try:
        code = _app(arguments)(args=arguments, prog_name="vocalis", standalone_mode=False)
        sys.stdout.flush()
        return code or 0
    except UsageError as error:
        return _complain(error.format_message(), BAD_INPUT)
    except (KeyboardInterrupt, typer.Abort):
        return _complain("interrupted", INTERRUPTED)
    except BrokenPipeError:  # the reader closed the pipe
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except Exception as error:
        return _report(error)


def _report(error: Exception) -> int:
    from vfcore.errors import ParameterError, VocalisError

    if isinstance(error, ParameterError):
        return _complain(str(error), BAD_INPUT)
    if isinstance(error, VocalisError):
        return _complain(str(error), NO_ANSWER)
    raise error


def _complain(sentence: str, code: int) -> int:
    print(f"vocalis: {' '.join(sentence.split())}", file=sys.stderr)
    return code


def _options(
    version: Annotated[bool, typer.Option("--version", is_eager=True, help="print the version and stop")] = False,
) -> None:
    if version:
        print(f"vocalis {metadata.version('vocalis')}")
        raise typer.Exit


def _app(arguments: Sequence[str]) -> typer.Typer:
    app = typer.Typer(
        help=PURPOSE, epilog=EPILOG, add_completion=False, invoke_without_command=True, rich_markup_mode="markdown"
    )
    app.callback()(_options)
    wanted = next((argument for argument in arguments if argument in COMMANDS), None)
    for name, summary in COMMANDS.items():
        if name == wanted:
            import_module(f"vocalis.cli.{name}").register(app, summary)
        else:
            app.command(name, help=summary)(lambda: None)
    return app
