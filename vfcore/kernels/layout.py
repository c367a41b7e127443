"""Layout of the flat buffer that the step works on: offsets of every field of one fold, or of several folds.

A field has ``ny`` rows (y = 0 first) of ``stride`` numbers: columns along x, each of ``folds`` adjacent numbers, one
per fold. Column 0 is the anterior end x = 0, column nx−1 the posterior end; a zero inverse density holds both at rest.
The step processes ``lanes`` adjacent numbers at a time, from column 1 on: ``lanes`` columns of one fold (``folds = 1``;
idle columns pad the last vector), or the same column of ``lanes`` folds (``folds = lanes``).

::

    row:  | pad | x=0 | 1 … nx−2 | x=L | idle … | pad |
            ^     ^     ^ first
            |     anterior

Offsets are constants of the compiled loop, so the compiler can prove that rows do not overlap.
"""

from dataclasses import dataclass

#: Numbers per SIMD vector: 512 bits. On processors with 256-bit vectors these are two, which fills the pipelines.
LANES = {"float64": 8, "float32": 16}
LINE = 8  # numbers (float64) of a cache line


@dataclass(frozen=True)
class Layout:
    """Offsets (in numbers) for grids of nx × ny nodes, ends included."""

    nx: int
    ny: int
    lanes: int = LANES["float64"]
    folds: int = 1

    @property
    def columns(self) -> int:
        """Columns processed, from column 1: the interior, the posterior end, idle columns."""
        per_vector = self.lanes // self.folds
        return -(-(self.nx - 1) // per_vector) * per_vector

    @property
    def anterior(self) -> int:
        """Index of column 0 in a row. One fold: column 1 starts on a cache line."""
        return LINE - 1 if self.folds == 1 else 0

    @property
    def stride(self) -> int:
        """Length of a row. Several folds: an odd number of columns, because rows a power of two apart map to the same
        cache sets and evict each other."""
        if self.folds > 1:
            return (self.nx | 1) * self.folds
        return LINE * (1 + -(-(self.columns + 1) // LINE))

    @property
    def first(self) -> int:
        """Offset of column 1 in a row."""
        return (self.anterior + 1) * self.folds

    @property
    def worked(self) -> int:
        """Numbers of a row that the step processes."""
        return self.columns * self.folds

    def field(self, name: str) -> int:
        """Offset of row y = 0 of a field of ny rows."""
        return FIELDS.index(name) * self.ny * self.stride

    def line(self, name: str) -> int:
        """Offset of a single row over x."""
        return (len(FIELDS) * self.ny + LINES.index(name)) * self.stride

    @property
    def block(self) -> int:
        """Vectors that go through a phase of the step before the next phase starts; the fastest values measured."""
        return 3 if self.folds == 1 else 2

    @property
    def K_coup(self) -> int:
        """Offset of the coupling stiffness, (ny, folds) numbers."""
        return (len(FIELDS) * self.ny + len(LINES)) * self.stride

    def scratch(self, name: str) -> int:
        """Offset of a scratch array, (block, ny, lanes) numbers."""
        return self.K_coup + (1 + SCRATCH.index(name) * self.block) * self.ny * self.lanes

    @property
    def beam_inverse(self) -> int:
        """Offset of (I − dt²A/4)⁻¹, one fold only: nx−2 rows of ``worked`` numbers, one per column of the matrix.

        Several folds store the banded factors instead, as lines.
        """
        return self.K_coup + (1 + len(SCRATCH) * self.block) * self.ny * self.lanes

    @property
    def size(self) -> int:
        """Length of the buffer."""
        return self.beam_inverse + (self.nx - 2 if self.folds == 1 else 0) * self.worked


# State: displacement, velocity at the half step, velocity extrapolated to the time of the displacement; phi likewise.
# Scratch: w_next, displacement after the step. Fixed: medial plane G.
FIELDS = ("w", "v", "v_star", "phi", "vphi", "vphi_star", "w_next", "G")
# State of the beam: w_b to v_star_b. Scratch: beam_force. Fixed: load of the end moments, 1/ρ_s, width of the slice,
# index of the column, and for several folds the factors 1/D, a and c of I − dt²A/4 (kernels/banded.py).
# From the last steps: ``beyond``, 1 where a displacement passed its bound; ``half_min``, smallest half gap of a slice.
LINES = (
    "w_b",
    "v_b",
    "v_star_b",
    "beam_force",
    "beam_load",
    "inverse_density",
    "width",
    "column",
    "inv_D",
    "a",
    "c",
    "beyond",
    "half_min",
)
# Of the columns of a block: 1/d_g²; half of the running min d_g from the inlet, signed; the viscous integral. ``slice``
# has three rows: half of max d_g, later replaced by the flux per width; half of d_sep; 1/Δ (kernels/flow.py).
SCRATCH = ("square", "running_min", "viscous", "slice")

# Scalars of the step, in this order in the parameter array.
SCALARS = (
    "dt",
    "dy",
    "alpha_s",
    "half_rho_a",
    "twelve_mu_a",
    "T_over_dx2",
    "G_shear_over_dy2",
    "eta_shear_over_dy2",
    "C_coup",
    "K_col",
    "C_col",
    "K_foun",
    "C_foun",
    "inv_beam_density",
    "inv_rotation_inertia",
    "G_rotation",
    "eta_rotation",
)

# Columns of the record: one row per recorded step.
RECORD = (
    "glottal_area_m2",
    "glottal_flow_m3_s",
    "contact_pressure_max_pa",
    "contact_column",
    "contact_area_m2",
    "inlet_pressure_pa",
    "outlet_pressure_pa",
)
