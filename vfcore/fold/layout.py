"""Layout of the flat buffer that the step works on: offsets of every field of one glottis, or of several.

A field has ``ny`` rows (y = 0 first) of ``stride`` numbers for each wall: columns along x, each of ``glottises``
adjacent numbers. Column 0 is the anterior end x = 0, column nx−1 the posterior end; a zero inverse density holds both
at rest. A second wall is ny further rows of the same columns. The step processes ``lanes`` adjacent numbers at a time,
from column 1 on: ``lanes`` columns of one glottis (idle columns pad the last vector), or the same column of ``lanes``
glottises.

::

    row:  | pad | x=0 | 1 … nx−2 | x=L | idle … | pad |
            ^     ^     ^ first
            |     anterior

From ``fixed`` on lies what does not change during a run at a constant posture; a gliding voice interpolates it. Offsets
are constants of the compiled loop, so the compiler can prove that rows do not overlap.
"""

from dataclasses import dataclass, field
from functools import lru_cache

from vfcore.fold.form import StepForm
from vfcore.fold.terms import GLOTTIS_NUMBERS, WALL_NUMBERS

LINE = 8  # numbers (float64) of a cache line

# State of the membrane: displacement, velocity at the half step, velocity extrapolated to the time of the displacement.
# Scratch: w_next, displacement after the step.
STATE = ("w", "v", "v_star", "w_next")
#: The same of the rotation φ on half rows.
ROTATION = ("phi", "vphi", "vphi_star")
#: State of the beam, and scratch: its force.
BEAM = ("w_b", "v_b", "v_star_b", "beam_force")
# Of the glottis, from the last step: ``beyond``, 1 where a displacement passed its bound; ``half_min``, smallest half
# gap of a slice.
GLOTTIS = ("beyond", "half_min")
# Scratch of the columns of a block: 1/d_g²; half of the running min d_g from the inlet, signed; the viscous integral;
# pressure on both walls. ``slice`` has four rows: half of max d_g; half of d_sep; 1/Δ; flux per width (terms/air.py).
SCRATCH = ("square", "running_min", "viscous", "pressure", "slice")
#: Fixed fields of a wall: the medial plane, then material that varies over the surface (fold/material.py).
MEDIAL = "G"
PATCHED = ("inverse_mass", "tension_share", "shear", "shear_viscosity", "coupling", "coupling_damper")
#: Fixed fields of the pair of walls.
PATCHED_PAIR = ("contact", "contact_damper")
#: Fixed lines of a wall: load of the end moments over ρ_l, 1/ρ_s.
LINES = ("beam_load", "inverse_density")
#: Fixed lines of a wall for several glottises: the factors 1/D, a and c of I − dt²A/4 (kernels/banded.py).
FACTORS = ("inv_D", "a", "c")
#: Law of the tension of each slot with finite stretch (terms/tension.py): gain of e, A, B, C, z_0, α.
LAW = ("law_gain", "law_A", "law_B", "law_C", "law_z", "law_alpha")
#: Fixed lines of the glottis: width of the slice, index of the column.
SHARED_LINES = ("width", "column")


@dataclass(frozen=True)
class Layout:
    """Offsets (in numbers) of everything in a buffer of a form."""

    form: StepForm
    offsets: dict[tuple[str, int], int] = field(default_factory=dict, compare=False)
    fixed: int = field(default=0, init=False)
    size: int = field(default=0, init=False)

    def __post_init__(self) -> None:
        form, at = self.form, 0
        one = max(LINE, form.lanes)

        def place(name: str, count: int, wall: int = 0) -> None:
            nonlocal at
            self.offsets[name, wall] = at
            at += -(-count // one) * one

        def each(names: tuple[str, ...], count: int) -> None:
            for name in names:
                for wall in range(form.walls):
                    place(name, count, wall)

        rows = form.ny * self.stride
        each(STATE + (ROTATION if form.rotation else ()), rows)
        each(BEAM, self.stride)
        for name in GLOTTIS:
            place(name, self.stride)
        for name in SCRATCH[:-1]:
            place(name, self.block * form.ny * form.lanes)
        place(SCRATCH[-1], 4 * self.block * form.lanes)
        if form.finite:
            each(("slot_sum",), self.slots * form.lanes)
            each(("slot_stretch", "slot_tension"), self.slots * (form.lanes if form.many else 1))
        object.__setattr__(self, "fixed", at)
        each((MEDIAL, *(PATCHED if form.patched else ())), rows)
        for name in PATCHED_PAIR if form.patched else ():
            place(name, rows)
        each(LINES + (FACTORS if form.many else ()), self.stride)
        for name in SHARED_LINES:
            place(name, self.stride)
        each(("K_coup",), self.rows)
        if form.finite:
            each(LAW, self.slots * form.glottises)
        if not form.many:
            each(("beam_inverse",), (form.nx - 2) * self.worked)
        place("numbers", len(GLOTTIS_NUMBERS) * form.glottises)
        each(("wall_numbers",), len(WALL_NUMBERS) * form.glottises)
        object.__setattr__(self, "size", at)

    @property
    def columns(self) -> int:
        """Columns processed, from column 1: the interior, the posterior end, idle columns."""
        per_vector = self.form.lanes // self.form.glottises
        return -(-(self.form.nx - 1) // per_vector) * per_vector

    @property
    def anterior(self) -> int:
        """Index of column 0 in a row. One glottis: column 1 starts on a cache line."""
        return 0 if self.form.many else LINE - 1

    @property
    def stride(self) -> int:
        """Length of a row. Several glottises: an odd number of columns, because rows a power of two apart map to the
        same cache sets and evict each other."""
        if self.form.many:
            return (self.form.nx | 1) * self.form.lanes
        return LINE * (1 + -(-(self.columns + 1) // LINE))

    @property
    def first(self) -> int:
        """Offset of column 1 in a row."""
        return (self.anterior + 1) * self.form.glottises

    @property
    def worked(self) -> int:
        """Numbers of a row that the step processes."""
        return self.columns * self.form.glottises

    @property
    def rows(self) -> int:
        """Numbers of a column over y, one per row and glottis; of one glottis a whole number of vectors."""
        form = self.form
        return form.ny * form.lanes if form.many else -(-form.ny // form.lanes) * form.lanes

    @property
    def slots(self) -> int:
        """Layers whose tension follows their stretch: the rows of the membrane, ligament and TA; of one glottis filled
        up to whole vectors."""
        form = self.form
        return form.ny + 2 if form.many else -(-(form.ny + 2) // form.lanes) * form.lanes

    @property
    def block(self) -> int:
        """Vectors that go through a phase of the step before the next phase starts.

        The fastest values measured; with airways all of them, since the flow of the whole glottis comes first.
        """
        form = self.form
        if form.coupled:
            return self.worked // form.lanes
        return 2 if form.many else 3

    def at(self, name: str, wall: int = 0) -> int:
        """Offset of an entry; of a field its row y = 0."""
        return self.offsets[name, wall]

    def wall(self, name: str) -> int:
        """Distance between the entries of the two walls; 0 with one wall."""
        return self.at(name, 1) - self.at(name) if self.form.walls == 2 else 0

    def number(self, name: str) -> int:
        """Place of a number of the glottis in units of ``glottises`` numbers, as ``simd.load_param`` counts."""
        return self.at("numbers") // self.form.glottises + GLOTTIS_NUMBERS.index(name)

    def wall_number(self, name: str) -> int:
        """The same of a number of the first wall."""
        return self.at("wall_numbers") // self.form.glottises + WALL_NUMBERS.index(name)


@lru_cache(maxsize=64)
def layout_of(form: StepForm) -> Layout:
    """The layout of a form."""
    return Layout(form)
