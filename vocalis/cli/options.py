"""Options that set fields of the request, generated from the parameter schema with its ranges, units and help."""

import inspect
from collections.abc import Callable, Mapping
from typing import Annotated, Any, NamedTuple

import typer

from vfcore.spec.presets import PRESETS
from vfcore.spec.request import flat, resolve
from vfcore.spec.schema import parameter_schema
from vocalis.cli.requests import request_patch

MUSCLES, BREATH, MODEL, RUN, START = "Muscles", "Breath and tract", "Model", "Run", "Source of the request"


class RequestOption(NamedTuple):
    """One option: its flag, the field of the request it sets, its panel in the help."""

    flag: str
    key: str
    panel: str

    @property
    def name(self) -> str:
        return self.flag.lstrip("-").replace("-", "_")


def _options(panel: str, **keys: str) -> tuple[RequestOption, ...]:
    return tuple(RequestOption(f"--{name.replace('_', '-')}", key, panel) for name, key in keys.items())


_MUSCLES = _options(MUSCLES, **{key: f"activation.{key}" for key in ("ta", "ct", "lca", "ia", "pca")})
_BREATH = _options(BREATH, pressure="subglottal_pressure_pa", pressure_rise="run.pressure_rise_s", vowel="vowel")
_SETS = _options(MODEL, variant="model.variant", posture_set="model.posture_set")
_COUPLING = _options(MODEL, coupling="model.coupling", stretch="model.stretch")
_EQUATIONS = _options(
    MODEL, coupling_gradient="model.coupling_gradient", shear="model.shear", convergence_angle="convergence_angle_rad"
)
_GRID = _options(RUN, nx="run.nx", ny="run.ny")
_RUN = _options(RUN, duration="run.duration_s", time_step="run.time_step_s", start="run.start")
_ESTIMATE = _options(RUN, error_estimate="run.error_estimate")

POSTURE_OPTIONS = (*_MUSCLES, *_SETS)
SHAPE_OPTIONS = (*_MUSCLES, *_SETS, *_EQUATIONS, *_GRID)
SIMULATE_OPTIONS = (*_MUSCLES, *_BREATH, *_SETS, *_COUPLING, *_EQUATIONS, *_RUN, *_GRID, *_ESTIMATE)

_ROWS = {row["key"]: row for row in parameter_schema()}
_PRESET_NAMES = ", ".join(preset.key for preset in PRESETS)
_SOURCES = ("preset", "request", "set")


def takes_request(
    options: tuple[RequestOption, ...],
    make: Callable[[dict[str, Any]], Any] = resolve,
    read: Callable[[Any], dict[str, Any]] = flat,
) -> Callable:
    """Decorator: the command gets ``request``, made from ``options``, --preset, --request and --set.

    ``make`` turns the patch into the argument of the command, by default a Simulation; ``read`` turns the document of
    --request into a patch.
    Later overrides earlier: preset, request file, single options, --set. ParameterError for invalid input.
    """

    def decorate(command: Callable) -> Callable:
        own = [
            parameter.replace(kind=inspect.Parameter.KEYWORD_ONLY)
            for parameter in inspect.signature(command).parameters.values()
            if parameter.name != "request"
        ]

        def request_command(**values: Any) -> Any:
            preset, path, settings = (values.pop(name) for name in _SOURCES)
            given = {option.key: values.pop(option.name) for option in options}
            return command(request=make(request_patch(preset, path, _changes(given), settings or [], read)), **values)

        wrapper: Any = request_command  # a function with a signature of its own
        parameters = [*_option_parameters(options), *_source_parameters(), *own]
        wrapper.__signature__ = inspect.Signature(parameters)
        wrapper.__annotations__ = {parameter.name: parameter.annotation for parameter in parameters}
        wrapper.__doc__ = command.__doc__
        return wrapper

    return decorate


def _changes(given: Mapping[str, str | bool | None]) -> dict[str, Any]:
    """The values of single options by path."""
    return {
        key: text if isinstance(text, bool) or _ROWS[key]["type"] == "choice" else number_or_text(text)
        for key, text in given.items()
        if text is not None
    }


def number_or_text(text: str) -> int | float | str | list:
    """``text`` as a number or as breakpoints (``0:0.1,1.5:0.9``), otherwise unchanged, for the validation of the
    request.
    """
    if ":" in text:
        return [[number_or_text(part) for part in pair.split(":", 1)] for pair in text.split(",")]
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text


def _parameter(name: str, annotation) -> inspect.Parameter:
    return inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=annotation)


def _option_parameters(options: tuple[RequestOption, ...]):
    for option in options:
        row = _ROWS[option.key]
        is_flag = row["type"] == "boolean"
        information = typer.Option(
            f"{option.flag}/--no-{option.flag[2:]}" if is_flag else option.flag,
            metavar=None if is_flag else "NAME" if row["type"] == "choice" else "NUMBER",
            help=_help(row),
            show_default=False,
            rich_help_panel=option.panel,
        )
        yield _parameter(option.name, Annotated[(bool if is_flag else str) | None, information])


def _help(row: Mapping[str, Any]) -> str:
    parts = [row["label"] + (f": {row['help']}" if row["help"] else "")]
    if row["type"] == "choice":
        parts.append(", ".join(row["options"]))
    elif row["type"] != "boolean":
        unit = "" if row["unit"] == "1" else f" {row['unit']}"
        parts.append(f"{row['min']:g} to {row['max']:g}{unit}")
    if row["default"] is not None and row["type"] != "boolean":
        parts.append(f"default {row['default']}")
    return "; ".join(parts)


def _source_parameters():
    yield _parameter(
        "preset",
        Annotated[
            str | None,
            typer.Option(
                "--preset", metavar="NAME", help=f"start from a voice: {_PRESET_NAMES}", rich_help_panel=START
            ),
        ],
    )
    yield _parameter(
        "request",
        Annotated[
            str | None,
            typer.Option(
                "--request",
                metavar="FILE|-",
                help="a request document in JSON; - reads it from standard input",
                rich_help_panel=START,
            ),
        ],
    )
    yield _parameter(
        "set",
        Annotated[
            list[str] | None,
            typer.Option(
                "--set",
                metavar="PATH=VALUE",
                rich_help_panel=START,
                help="any field of the request, repeatable: constants.K_col_pa_m=2e6, run.start=static; of one fold: "
                "right.activation.ta=0.1; of the first lesion: lesions.0.kind=nodule, lesions.0.height_mm=0.6",
            ),
        ],
    )
