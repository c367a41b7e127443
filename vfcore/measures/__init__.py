"""Measures of a run: the phonation state first, then every measure of one catalogue."""

from vfcore.measures.catalogue import CATALOGUE, Catalogue, MeasureReport, measure_all
from vfcore.measures.measure import Measure
from vfcore.measures.measure_spec import MeasureSpec, NormalRange
from vfcore.measures.signals import Signals

__all__ = [
    "CATALOGUE",
    "Catalogue",
    "Measure",
    "MeasureReport",
    "MeasureSpec",
    "NormalRange",
    "Signals",
    "measure_all",
]
