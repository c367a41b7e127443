"""A sweep as an xarray Dataset: what ``xarray.open_dataset`` gives for its netCDF file, without the file.

Needs xarray, which is not a dependency of Vocalis.
"""

from typing import TYPE_CHECKING

from vfcore.runs.sweep.files import attributes, variables
from vfcore.runs.sweep.table import SweepTable

if TYPE_CHECKING:
    import xarray


def dataset(table: SweepTable) -> "xarray.Dataset":
    """Dims: the axes; variables: scalars with units, ``phonation_state`` as labels; ImportError without xarray."""
    import xarray

    found = {name: (one.dims, one.values, dict(one.attributes)) for name, one in variables(table).items()}
    coordinates = {name: found.pop(name) for name in [axis.name for axis in table.sweep.axes]}
    return xarray.Dataset(found, coordinates, attributes(table))
