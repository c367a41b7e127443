"""Many simulations over one to three axes or a list of points: one document in, one table out.

>>> from vfcore.runs.sweep import run_sweep, sweep_from_dict
>>> sweep = sweep_from_dict({"axes": [{"parameter": "activation.ct", "values": [0.2, 0.4]}]})
>>> table = run_sweep(sweep, workers=1)
>>> table.measure("fo_hz").shape
(2,)

No server is needed. ``vfcore.runs.sweep.dataset`` makes an xarray Dataset of a table, ``vfcore.runs.sweep.files``
netCDF and CSV.
"""

from vfcore.runs.sweep.document import sweep_from_dict, sweep_to_dict
from vfcore.runs.sweep.plan import Axis, Sweep
from vfcore.runs.sweep.run import run_sweep
from vfcore.runs.sweep.table import SweepTable

__all__ = ["Axis", "Sweep", "SweepTable", "run_sweep", "sweep_from_dict", "sweep_to_dict"]
