"""A rendered gesture as plain values for JSON, as a CSV table of its contours, and as a netCDF-4 file."""

import csv
import io
import os
from typing import Any

import numpy as np

from vfcore.io.atomic import replacing
from vfcore.io.hdf5 import Variable, write_variables
from vfcore.io.result_document import json_text, measure_document, without_gaps
from vfcore.runs.gesture.gesture import gesture_to_dict
from vfcore.runs.gesture.render import RATE_HZ, RenderedGesture
from vfcore.runs.result import ARRAYS
from vfcore.spec.fields import PAPER
from vfcore.spec.paths import known_declaration
from vfcore.version import CODE_VERSION, MODEL_VERSION

#: Unit and name of each contour that is not a parameter of the request.
CONTOURS = {
    "time_s": ("s", "time"),
    "fo_hz": ("Hz", "fundamental frequency"),
    "spl_lips_db": ("dB re 20 µPa", "level at the lips"),
    "spl_30cm_db": ("dB re 20 µPa", "level at 0.3 m"),
    "strain": ("1", "nominal fold strain"),
    "glottal_half_angle_rad": ("rad", "glottal half-angle"),
    "length_m": ("m", "fold length"),
}


def gesture_document(rendered: RenderedGesture) -> dict[str, Any]:
    """Contours, segments with their measures, and the gesture itself; strict JSON."""
    return without_gaps(
        {
            "kind": "gesture",
            "duration_s": len(rendered.waves["time_s"]) / RATE_HZ,
            "contours": {
                name: {"unit": unit, "label": label, "values": values.tolist()}
                for name, values in rendered.contours.items()
                for unit, label in (_quantity(name),)
            },
            "segments": [
                {
                    "start_s": segment.start_s,
                    "end_s": segment.end_s,
                    "phonation_state": segment.report.state,
                    "explanation": segment.report.explanation,
                    "measures": {key: measure_document(m) for key, m in segment.report.measures.items()},
                }
                for segment in rendered.segments
            ],
            "audio_delay_s": rendered.audio_delay_s,
            "provenance": {
                "model_version": MODEL_VERSION,
                "code_version": CODE_VERSION,
                "request": gesture_to_dict(rendered.gesture),
            },
        }
    )


def contour_csv(rendered: RenderedGesture) -> str:
    """One row per 10 ms; an empty cell where there is no value."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(rendered.contours)
    for row in zip(*rendered.contours.values(), strict=True):
        writer.writerow(["" if np.isnan(value) else repr(float(value)) for value in row])
    return text.getvalue()


def write_gesture_netcdf(rendered: RenderedGesture, path: str | os.PathLike) -> None:
    """Write waves over ``time`` and contours over ``block``, atomically; OSError where ``path`` cannot be written."""
    with replacing(path) as draft:
        write_variables(draft, *_content(rendered))


def gesture_netcdf_bytes(rendered: RenderedGesture) -> bytes:
    """The same file as bytes."""
    buffer = io.BytesIO()
    write_variables(buffer, *_content(rendered))
    return buffer.getvalue()


def _content(rendered: RenderedGesture) -> tuple[dict[str, Variable], dict[str, str]]:
    variables = {
        name: Variable(("time",), wave, {"units": ARRAYS[name].unit, "long_name": ARRAYS[name].label})
        for name, wave in rendered.waves.items()
    }
    for name, values in rendered.contours.items():
        unit, label = _quantity(name)
        variables[f"contour_{name.replace('.', '_')}"] = Variable(
            ("block",), values, {"units": unit, "long_name": label}
        )
    attributes = {
        "title": "Vocalis gesture: a voice whose parameters move",
        "source": f"Vocalis {CODE_VERSION}, model {MODEL_VERSION}",
        "references": PAPER,
        "request": json_text(gesture_to_dict(rendered.gesture)),
    }
    return variables, attributes


def _quantity(name: str) -> tuple[str, str]:
    """Unit and name of a contour: one of CONTOURS, or a number of the request."""
    if name in CONTOURS:
        return CONTOURS[name]
    metadata = known_declaration(name).metadata
    return metadata["unit"], metadata["label"]
