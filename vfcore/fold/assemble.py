"""Assembly of a glottis: from postures and coefficients to its walls, and to the buffer that the step works on."""

from collections.abc import Sequence
from dataclasses import astuple, dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from vfcore.fold.assembly import Offsets, place_glottis, place_wall, wall_of
from vfcore.fold.constants import FoldConstants
from vfcore.fold.form import StepForm
from vfcore.fold.layout import Layout, layout_of
from vfcore.fold.material import FIELDS, PATCH
from vfcore.fold.terms import GLOTTIS_NUMBERS, WALL_NUMBERS
from vfcore.fold.terms.beam import BANDS
from vfcore.fold.terms.contact import in_series
from vfcore.kernels.simd import aligned_zeros
from vfcore.larynx.tissue.coefficients import Coefficients
from vfcore.larynx.tissue.prestrain import Constants
from vfcore.spec.simulation import Simulation

NO_PATCHES = np.empty((0, len(PATCH)))
_COEFFICIENTS = 12  # those that the assembler takes
_NAMES: tuple[str, ...] = Constants._fields


@dataclass(frozen=True, eq=False)
class Fold:
    """One prestrained fold on a grid, a wall of the glottis: everything the equations need except the state.

    Arrays: ``fields`` (9, ny, nx), vfcore.fold.material.FIELDS; ``bands`` (7,), the beam's; ``numbers``
    (len(WALL_NUMBERS),) of the step. ``finite``: its tension grows with the swing. ``patched``: its material varies
    over the surface.
    """

    nx: int
    ny: int
    rotation: bool
    finite: bool
    patched: bool
    strain: float
    a_ta: float
    coefficients: Coefficients
    constants: FoldConstants
    fields: np.ndarray
    bands: np.ndarray
    numbers: np.ndarray

    @property
    def dx(self) -> float:
        return self.coefficients.length_m / (self.nx - 1)

    @property
    def dy(self) -> float:
        return self.coefficients.thickness_m / (self.ny - 1)

    @cached_property
    def x_m(self) -> np.ndarray:
        """(nx,)."""
        return np.linspace(0.0, self.coefficients.length_m, self.nx)

    @cached_property
    def y_m(self) -> np.ndarray:
        """(ny,)."""
        return np.linspace(0.0, self.coefficients.thickness_m, self.ny)

    def field(self, name: str) -> np.ndarray:
        """A field (ny, nx) by its name in FIELDS."""
        return self.fields[FIELDS.index(name)]

    def number(self, name: str) -> float:
        """A number of the step by its name in WALL_NUMBERS."""
        return float(self.numbers[WALL_NUMBERS.index(name)])

    @property
    def medial_plane_m(self) -> np.ndarray:
        """G (ny, nx)."""
        return self.field("G")

    @cached_property
    def beam_matrix_n_m2(self) -> np.ndarray:
        """A (nx−2, nx−2): force per length on the inner nodes of the beam is A w_b + load."""
        return beam_operator(self.bands, self.nx - 2)[0]

    @cached_property
    def beam_load_n_m(self) -> np.ndarray:
        """The load of the end moments (nx−2,)."""
        return beam_operator(self.bands, self.nx - 2)[1]


def beam_operator(bands: np.ndarray, n: int) -> tuple[np.ndarray, np.ndarray]:
    """Matrix (n, n), N/m², and load (n,), N/m, of the beam from its ``bands``, vfcore.fold.terms.beam.BANDS."""
    at_0, centre, at_L, first, second, load_0, load_L = bands
    matrix = np.zeros((n, n))
    flat = matrix.ravel()
    for shift, value in enumerate((centre, first, second)):
        flat[shift : (n - shift) * n : n + 1] = value  # above the diagonal
        flat[shift * n :: n + 1] = value  # below
    matrix[0, 0], matrix[-1, -1] = at_0, at_L
    load = np.zeros(n)
    load[0] = load_0
    load[-1] += load_L
    return matrix, load


@dataclass(frozen=True, eq=False)
class Glottis:
    """One fold and its mirror image, or a left and a right fold on the same grid."""

    walls: tuple[Fold, ...]

    @property
    def nx(self) -> int:
        return self.walls[0].nx

    @property
    def ny(self) -> int:
        return self.walls[0].ny

    @cached_property
    def width_m(self) -> float:
        """Width of a slice: the mean spacing of the walls along x."""
        return sum(wall.dx for wall in self.walls) / len(self.walls)

    @cached_property
    def dy(self) -> float:
        """Spacing that the flow sees: the mean of the walls."""
        return sum(wall.dy for wall in self.walls) / len(self.walls)

    @cached_property
    def contact(self) -> tuple[np.ndarray, np.ndarray]:
        """Stiffness and damper of the contact of the pair, (ny, nx) each, Pa/m and Pa·s/m."""
        left, right = self.walls[0], self.walls[-1]
        if left is right:
            return left.field("contact"), left.field("contact_damper")
        stiffness, damper = (in_series(left.field(name), right.field(name)) for name in ("contact", "contact_damper"))
        return stiffness, damper

    def with_walls(self, count: int) -> "Glottis":
        """The same glottis with at least ``count`` walls: a fold and its mirror image as two."""
        return self if len(self.walls) >= count else Glottis(self.walls * count)

    def form(self, coupled: bool = False, many: bool = False, precision: str = "float64") -> StepForm:
        """The form of the step of this glottis; ``coupled``: the airways act back."""
        first = self.walls[0]
        return StepForm(
            nx=first.nx,
            ny=first.ny,
            walls=len(self.walls),
            rotation=first.rotation,
            finite=first.finite,
            patched=any(wall.patched for wall in self.walls),
            coupled=coupled,
            many=many,
            precision=precision,
        )


def assemble(request: Simulation, strain: float, c: Coefficients, theta_g: float, theta_0: float) -> Fold:
    """The fold of a request at a given posture: ``strain`` ε̄, coefficients ``c``, and in rad the half-angle ``theta_g``
    of the posture (negative for a side that crosses the midline) and the rest angle ``theta_0``.
    """
    nx, ny = request.run.nx, request.run.ny
    model, constants = request.model, request.constants
    patches = _patches(request)
    fields, bands = np.empty((len(FIELDS), ny, nx)), np.empty(len(BANDS))
    numbers = np.empty(len(WALL_NUMBERS))
    wall_of(
        tuple(map(float, astuple(c)[:_COEFFICIENTS])),
        float(strain),
        float(request.activation.ta),
        float(theta_g),
        float(theta_0),
        float(np.tan(request.convergence_angle_rad)),
        float(np.tan(theta_g)),
        model.coupling_gradient == "inferior_stiff",
        packed(constants),
        patches,
        fields,
        bands,
        numbers,
    )
    return Fold(
        nx=nx,
        ny=ny,
        rotation=model.shear == "rotation",
        finite=model.stretch == "finite",
        patched=len(patches) > 0,
        strain=strain,
        a_ta=request.activation.ta,
        coefficients=c,
        constants=constants,
        fields=fields,
        bands=bands,
        numbers=numbers,
    )


def _patches(request: Simulation) -> np.ndarray:
    """The lesions of a request as the assembler takes them, (n, 8), vfcore.fold.material.PATCH."""
    if not request.lesions:
        return NO_PATCHES
    return np.array(
        [
            (
                lesion.x,
                lesion.y,
                1e-3 * lesion.length_mm,
                1e-3 * lesion.width_mm,
                1e-3 * lesion.height_mm,
                lesion.mass_ratio,
                lesion.stiffness_ratio,
                lesion.viscosity_ratio,
            )
            for lesion in request.lesions
        ],
        np.float64,
    )


@lru_cache(maxsize=64)
def packed(constants: FoldConstants) -> Any:
    """The constants in the form that the compiled assembler takes."""
    return Constants(*(float(getattr(constants, name)) for name in _NAMES))


def empty_buffer(layout: Layout) -> np.ndarray:
    """Zeros (layout.size,) aligned to a cache line, so that speed does not depend on where the buffer is allocated."""
    return aligned_zeros(layout.size, layout.form.precision)


def new_buffer(glottis: Glottis, form: StepForm, time_step_s: float) -> np.ndarray:
    """A buffer of one glottis with its fixed numbers filled, flat and at rest."""
    layout = layout_of(form)
    buffer = empty_buffer(layout)
    fill(buffer, layout, 0, glottis, time_step_s)
    return buffer


def fill(buffer: np.ndarray, layout: Layout, place: int, glottis: Glottis, time_step_s: float) -> None:
    """Write the fixed numbers of ``glottis`` as number ``place`` of ``buffer``."""
    c = glottis.walls[0].constants
    K_col, C_col = glottis.contact
    numbers = {
        "dt": time_step_s,
        "dy": glottis.dy,
        "alpha_s": c.alpha_s,
        "half_rho_a": 0.5 * c.rho_a_kg_m3,
        "twelve_mu_a": 12.0 * c.mu_a_pa_s,
        "K_col": K_col[0, 0],
        "C_col": C_col[0, 0],
    }
    shared = np.array([numbers[name] for name in GLOTTIS_NUMBERS])
    work = np.empty((3, glottis.nx - 2))
    for side, wall in enumerate(glottis.walls):
        offsets = _offsets(layout.form, side)
        inv_rho_s = 1.0 / wall.coefficients.membrane_density_kg_m2
        fields = wall.fields if side == 0 else _meeting(glottis.walls[0], wall)
        place_wall(fields, wall.bands, wall.numbers, inv_rho_s, time_step_s, offsets, place, work, buffer)
    place_glottis(K_col, C_col, glottis.width_m, shared, _offsets(layout.form, 0), place, buffer)


def _meeting(left: Fold, right: Fold) -> np.ndarray:
    """The fields of the right wall, its medial plane exactly at the left one where the two meet to rounding.

    Folds that close off the midline have planes of opposite sign there; the last digit of their sum must not decide
    whether they touch.
    """
    plane, opposite = right.medial_plane_m, -left.medial_plane_m
    met = (plane != opposite) & (np.abs(plane - opposite) < MEETING * np.abs(plane))
    if not met.any():
        return right.fields
    fields = right.fields.copy()
    fields[FIELDS.index("G")][met] = opposite[met]
    return fields


@lru_cache(maxsize=64)
def _offsets(form: StepForm, side: int) -> Offsets:
    """What the compiled assembler needs of the layout of a form, for the wall ``side``."""
    layout = layout_of(form)

    def at(name: str) -> int:
        shared = layout.offsets.get((name, 0), -1)
        return layout.offsets.get((name, side), shared)

    sizes = layout.stride, layout.anterior, form.glottises, layout.worked
    return Offsets(*sizes, *(at(name) for name in Offsets._fields[len(sizes) :]))


def membranes(buffer: np.ndarray, layout: Layout, name: str = "w", side: int = 0) -> np.ndarray:
    """A view (ny, nx, glottises) of a field of a wall in the buffer, ends included."""
    form, start = layout.form, layout.at(name, side)
    field = buffer[start : start + form.ny * layout.stride].reshape(form.ny, -1, form.glottises)
    return field[:, layout.anterior : layout.anterior + form.nx]


def beams(buffer: np.ndarray, layout: Layout, name: str = "w_b", side: int = 0) -> np.ndarray:
    """A view (nx, glottises) of a line of a wall in the buffer, ends included."""
    start = layout.at(name, side)
    line = buffer[start : start + layout.stride].reshape(-1, layout.form.glottises)
    return line[layout.anterior : layout.anterior + layout.form.nx]


def beyond(buffer: np.ndarray, layout: Layout) -> np.ndarray:
    """A view (lanes,): not 0 for a glottis in which a displacement passed its bound in the last steps."""
    start = layout.at("beyond")
    return buffer[start : start + layout.form.lanes]


def start_flat(buffer: np.ndarray, layout: Layout, place: int, glottis: Glottis) -> None:
    """w = 1 nm · sin(πx/L) sin(πy/b) on every wall, everything else at rest."""
    for side, wall in enumerate(glottis.walls):
        bump = np.sin(np.pi * wall.y_m / wall.y_m[-1])[:, None] * np.sin(np.pi * wall.x_m / wall.x_m[-1])
        bump[[0, -1]], bump[:, [0, -1]] = 0.0, 0.0  # exact zeros: sin(π) is not
        membranes(buffer, layout, "w", side)[:, :, place] = FLAT_BUMP_M * bump


def start_static(
    buffer: np.ndarray, layout: Layout, place: int, glottis: Glottis, shapes: Sequence[tuple[np.ndarray, np.ndarray]]
) -> None:
    """Displacements w (ny, nx) and w_b (nx,) of every wall, at rest; with the rotation equation φ = ∂_y w, so that the
    shear is 0.
    """
    for side, (wall, (w, w_b)) in enumerate(zip(glottis.walls, shapes, strict=True)):
        membranes(buffer, layout, "w", side)[:, :, place] = w
        beams(buffer, layout, "w_b", side)[:, place] = w_b
        if layout.form.rotation:
            membranes(buffer, layout, "phi", side)[:-1, :, place] = np.diff(w, axis=0) / wall.dy


MEETING = 1e-13  # relative distance below which two medial planes meet: rounding, and far below any opening
FLAT_BUMP_M = 1e-9  # initial displacement of a flat start, as in an earlier version of the model
