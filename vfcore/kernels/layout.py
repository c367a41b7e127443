"""Where each field of a fold lives in the one flat buffer that the step works on.

One buffer with constant offsets lets the compiler prove that rows do not overlap, which is
what makes it vectorise over x. A field is ``ny`` rows (y = 0 first) of ``stride`` columns.
Column 0 is the anterior end x = 0, column nx−1 the posterior end; both are held at rest by a
zero inverse density. The step works on columns 1 … ``columns``, a multiple of the vector
length, so the posterior end and a few idle columns ride along.

::

    row:  | pad | x=0 | 1 … nx−2 | x=L | idle … | pad |
            ^     ^     ^ FIRST+1
            |     FIRST
"""

from dataclasses import dataclass

VECTOR = 4  # float64 lanes of a 256-bit register
FIRST = 3  # offset of column 0 in a row, so that column 1 starts on a vector boundary


@dataclass(frozen=True)
class Layout:
    """Offsets (in float64 elements) for a grid of nx × ny nodes, ends included."""

    nx: int
    ny: int

    @property
    def columns(self) -> int:
        """Columns worked on, from column 1: the interior, the posterior end, idle ones."""
        return -(-(self.nx - 1) // VECTOR) * VECTOR

    @property
    def stride(self) -> int:
        return self.columns + 2 * VECTOR

    def field(self, name: str) -> int:
        """Offset of row y = 0 of a field of ny rows (``running_min`` has ny + 1)."""
        return FIELDS.index(name) * (self.ny + 1) * self.stride

    def line(self, name: str) -> int:
        """Offset of a single row over x."""
        return (len(FIELDS) * (self.ny + 1) + LINES.index(name)) * self.stride

    @property
    def beam_inverse(self) -> int:
        """Offset of (I − dt²A/4)⁻¹, nx−2 rows of ``columns``, stored by column of the matrix."""
        return (len(FIELDS) * (self.ny + 1) + len(LINES)) * self.stride

    @property
    def size(self) -> int:
        return self.beam_inverse + (self.nx - 2) * self.columns


# State: displacement, velocity at the half step, last velocity increment; phi likewise.
# Fixed: medial plane G, coupling stiffness. Scratch: the rest.
FIELDS = (
    "w",
    "v",
    "dv",
    "phi",
    "vphi",
    "dvphi",
    "G",
    "K_coup",
    "reciprocal",
    "running_min",
    "viscous",
    "attached",
    "force",
    "flux",
)
STATE_FIELDS = ("w", "v", "dv", "phi", "vphi", "dvphi")
LINES = (
    "w_b",
    "v_b",
    "dv_b",
    "beam_force",
    "beam_acceleration",
    "beam_load",
    "inverse_density",
    "width",
    "slice_contact",
    "bernoulli",
    "viscous_line",
    "slice_flow",
)

# Scalars of the step, in this order in the parameter array.
SCALARS = (
    "dt",
    "dy",
    "alpha_s",
    "half_rho_a",
    "twelve_mu_a",
    "T_over_dx2",
    "G_shear",
    "eta_shear",
    "C_coup",
    "K_col",
    "C_col",
    "K_foun",
    "C_foun",
    "per_beam_density",
    "per_rotation_inertia",
    "G_rotation",
    "eta_rotation",
)

# Columns of the record: one row per recorded step.
RECORD = (
    "glottal_area_m2", "glottal_flow_m3_s", "contact_pressure_max_pa", "contact_column", "contact_area_m2",
    "inlet_pressure_pa", "outlet_pressure_pa",
)  # fmt: skip
