"""A sweep: pitch over two muscles, on all cores, printed as a table and written to map.nc in the current directory.

The guard at the end matters: worker processes import this file again.
"""

import numpy as np

from vfcore.runs.sweep import run_sweep, sweep_from_dict
from vfcore.runs.sweep.files import write_netcdf

CT, TA = (0.0, 0.5, 1.0), (0.1, 0.4)


def main() -> None:
    sweep = sweep_from_dict(
        {
            "base": {"subglottal_pressure_pa": 1000},
            "axes": [{"parameter": "activation.ct", "values": CT}, {"parameter": "activation.ta", "values": TA}],
            "measures": ["fo_hz", "closed_quotient"],
        }
    )
    table = run_sweep(sweep)
    pitch = table.measure("fo_hz")  # shape (CT, TA); NaN where there is no pitch
    print("f_o in Hz  " + "  ".join(f"TA {ta:g}" for ta in TA))
    for ct, row in zip(CT, pitch, strict=True):
        print(f"CT {ct:<8g} " + "  ".join("     –" if np.isnan(value) else f"{value:6.1f}" for value in row))
    write_netcdf(table, "map.nc")


if __name__ == "__main__":
    main()
