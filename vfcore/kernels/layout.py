"""Where each field of one fold, or of several side by side, lives in the one flat buffer that the step works on.

A field is ``ny`` rows (y = 0 first) of ``stride`` numbers: columns along x, each of ``postures`` neighbouring numbers,
one per fold. Column 0 is the anterior end x = 0, column nx−1 the posterior end; both are held at rest by a zero
inverse density. The step works on ``lanes`` neighbours at a time, from column 1 on: on columns of one fold
(``postures = 1``; a few idle columns ride along to fill the last lanes), or on the same column of ``lanes`` folds
(``postures = lanes``).

::

    row:  | pad | x=0 | 1 … nx−2 | x=L | idle … | pad |
            ^     ^     ^ first
            |     anterior

Offsets are constants of the compiled loop, so the compiler can prove that rows do not overlap.
"""

from dataclasses import dataclass

#: Numbers worked on together: 512 bits, twice what most processors take at once, which fills their pipelines.
LANES = {"float64": 8, "float32": 16}
LINE = 8  # numbers (float64) of a cache line


@dataclass(frozen=True)
class Layout:
    """Offsets (in numbers) for grids of nx × ny nodes, ends included."""

    nx: int
    ny: int
    lanes: int = LANES["float64"]
    postures: int = 1

    @property
    def columns(self) -> int:
        """Columns worked on, from column 1: the interior, the posterior end, idle ones."""
        together = self.lanes // self.postures
        return -(-(self.nx - 1) // together) * together

    @property
    def anterior(self) -> int:
        """The place of column 0 among the columns of a row: column 1 starts on a cache line."""
        return LINE - 1 if self.postures == 1 else 0

    @property
    def stride(self) -> int:
        """Length of a row; an odd number of columns of several folds, for rows a power of two apart share few places in
        the cache and would drive each other out."""
        if self.postures > 1:
            return (self.nx | 1) * self.postures
        return LINE * (1 + -(-(self.columns + 1) // LINE))

    @property
    def first(self) -> int:
        """Offset of column 1 in a row."""
        return (self.anterior + 1) * self.postures

    @property
    def worked(self) -> int:
        """Numbers of a row that the step works on."""
        return self.columns * self.postures

    def field(self, name: str) -> int:
        """Offset of row y = 0 of a field of ny rows."""
        return FIELDS.index(name) * self.ny * self.stride

    def line(self, name: str) -> int:
        """Offset of a single row over x."""
        return (len(FIELDS) * self.ny + LINES.index(name)) * self.stride

    @property
    def block(self) -> int:
        """Groups of columns that the step takes through its phases together, as many as was found to be fastest."""
        return 3 if self.postures == 1 else 2

    @property
    def K_coup(self) -> int:
        """Offset of the coupling stiffness, ny numbers for each of the postures."""
        return (len(FIELDS) * self.ny + len(LINES)) * self.stride

    def scratch(self, name: str) -> int:
        """Offset of scratch for the groups of a block: ny times ``lanes`` numbers each."""
        return self.K_coup + (1 + SCRATCH.index(name) * self.block) * self.ny * self.lanes

    @property
    def beam_inverse(self) -> int:
        """Offset of (I − dt²A/4)⁻¹ of one fold, nx−2 rows of ``worked`` numbers, stored by column of the matrix; many
        folds have its factors instead, among the lines.
        """
        return self.K_coup + (1 + len(SCRATCH) * self.block) * self.ny * self.lanes

    @property
    def size(self) -> int:
        return self.beam_inverse + (self.nx - 2 if self.postures == 1 else 0) * self.worked


# State: displacement, velocity at the half step, velocity extrapolated to the time of the displacement; phi likewise.
# Scratch: displacement after the step. Fixed: medial plane G.
FIELDS = ("w", "v", "v_star", "phi", "vphi", "vphi_star", "w_next", "G")
# State of the beam. Scratch: its load. Fixed: load of the end moments, 1/ρ_s, width of the slice, number of the column;
# of many folds the factors of I − dt²A/4 (kernels/banded.py), 1/D, a and c.
# What the last steps saw: displacements beyond all bounds; the smallest half gap of each slice.
LINES = (
    "w_b", "v_b", "v_star_b", "beam_force", "beam_load", "inverse_density", "width", "column", "per_D", "a", "c",
    "beyond", "half_min",
)  # fmt: skip
# Of the columns at hand: 1/d_g²; half of min d_g from the inlet, signed; the viscous integral. In the rows of the last:
# half of max d_g, then in its place the flux per width; half of d_sep; 1/Δ, how fast the smallest half gap changes.
SCRATCH = ("square", "running_min", "viscous", "slice")

# Scalars of the step, in this order in the parameter array.
SCALARS = (
    "dt",
    "dy",
    "alpha_s",
    "half_rho_a",
    "twelve_mu_a",
    "T_over_dx2",
    "G_shear_per_dy2",
    "eta_shear_per_dy2",
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
