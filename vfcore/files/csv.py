"""The scalar measures of a run as CSV: one row each, RFC 4180 quoting, UTF-8 text."""

import csv
import io

from vfcore.document import result_document
from vfcore.measures.catalogue import CATALOGUE
from vfcore.result import SimulationResult

COLUMNS = ("key", "symbol", "name", "value", "unit", "reason")


def csv_text(result: SimulationResult) -> str:
    """A header, the phonation state, then every measure of the catalogue.

    Numbers are written so that they read back exactly; a missing value is an empty cell with a reason.
    """
    document = result_document(result)
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(COLUMNS)
    writer.writerow(
        ("phonation_state", "", "phonation state", document["phonation_state"], "", document["explanation"])
    )
    for spec in CATALOGUE:
        measure = document["measures"][spec.key]
        value = "" if measure["value"] is None else repr(measure["value"])
        writer.writerow((spec.key, spec.symbol, spec.name, value, measure["unit"], measure["reason"] or ""))
    return text.getvalue()
