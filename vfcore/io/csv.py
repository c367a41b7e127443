"""The scalar measures of a run as CSV: one row each, RFC 4180 quoting, UTF-8 text."""

import csv
import io

from vfcore.io.result_document import result_document
from vfcore.measures.catalogue import CATALOGUE
from vfcore.runs.result import SimulationResult

COLUMNS = ("key", "symbol", "name", "value", "unit", "reason")
ERROR_COLUMNS = ("error_half_width", "error_reason")


def csv_text(result: SimulationResult) -> str:
    """A header, the phonation state, then every measure of the catalogue, with error bars where they were estimated.

    Numbers are written so that they read back exactly; a missing value is an empty cell with a reason.
    """
    document = result_document(result)
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    estimate = document["error_estimate"]
    writer.writerow((*COLUMNS, *(ERROR_COLUMNS if estimate else ())))
    state = ("phonation_state", "", "phonation state", document["phonation_state"], "", document["explanation"])
    writer.writerow((*state, *("" for _ in ERROR_COLUMNS if estimate)))
    for spec in CATALOGUE:
        measure = document["measures"][spec.key]
        row = (spec.key, spec.symbol, spec.name, _text(measure["value"]), measure["unit"], measure["reason"] or "")
        bar = estimate["measures"][spec.key] if estimate else {}
        writer.writerow((*row, *((_text(bar["half_width"]), bar["reason"] or "") if bar else ())))
    return text.getvalue()


def _text(value: float | None) -> str:
    return "" if value is None else repr(value)
