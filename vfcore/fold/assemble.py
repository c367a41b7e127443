"""Assembly of a fold: from a posture and its coefficients to the buffer that the step works on."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from vfcore.kernels.banded import factor
from vfcore.kernels.layout import Layout
from vfcore.kernels.tissue import coupling_stiffness, medial_plane, step_numbers
from vfcore.larynx.tissue.beam import beam_operator
from vfcore.larynx.tissue.coefficients import Coefficients
from vfcore.spec.fold_constants import FoldConstants
from vfcore.spec.simulation import Simulation

CACHE_LINE = 64  # bytes


@dataclass(frozen=True)
class Fold:
    """One prestrained fold on a grid: everything the equations need except the state.

    Arrays: ``x_m`` (nx,), ``y_m`` (ny,), ``medial_plane_m`` G (ny, nx), ``K_coup_pa_m`` (ny,),
    ``beam_matrix_n_m2`` (nx−2, nx−2) and ``beam_load_n_m`` (nx−2,).
    """

    nx: int
    ny: int
    rotation: bool
    coefficients: Coefficients
    constants: FoldConstants
    x_m: np.ndarray
    y_m: np.ndarray
    medial_plane_m: np.ndarray
    K_coup_pa_m: np.ndarray
    beam_matrix_n_m2: np.ndarray
    beam_load_n_m: np.ndarray

    @property
    def dx(self) -> float:
        return self.coefficients.length_m / (self.nx - 1)

    @property
    def dy(self) -> float:
        return self.coefficients.thickness_m / (self.ny - 1)


def assemble(request: Simulation, c: Coefficients, theta_g: float, theta_0: float) -> Fold:
    """The fold of a request at a given posture: ``theta_g`` is θ_g clipped at 0, ``theta_0`` the rest angle, rad."""
    nx, ny = request.run.nx, request.run.ny
    choices = request.model
    x = np.linspace(0.0, c.length_m, nx)
    y = np.linspace(0.0, c.thickness_m, ny)
    G = medial_plane(x, y[:, None], np.tan(theta_g), np.tan(request.convergence_angle_rad))
    from_stiff_edge = y / c.thickness_m
    if choices.coupling_gradient == "inferior_stiff":
        from_stiff_edge = 1.0 - from_stiff_edge
    matrix, load = beam_operator(nx, c, request.constants, theta_g, theta_0)
    return Fold(
        nx=nx,
        ny=ny,
        rotation=choices.shear == "rotation",
        coefficients=c,
        constants=request.constants,
        x_m=x,
        y_m=y,
        medial_plane_m=G,
        K_coup_pa_m=coupling_stiffness(from_stiff_edge, request.constants),
        beam_matrix_n_m2=matrix,
        beam_load_n_m=load,
    )


def scalars(fold: Fold, time_step_s: float) -> np.ndarray:
    """The step's parameter array, layout.SCALARS."""
    c = fold.coefficients
    return np.array(
        step_numbers(
            time_step_s,
            fold.dx,
            fold.dy,
            c.membrane_tension_n_m,
            c.membrane_shear_n_m,
            c.membrane_shear_viscosity_n_s_m,
            c.beam_density_kg_m,
            c.rotation_inertia_kg_m,
            fold.constants,
        )
    )


def empty_buffer(layout: Layout, precision: str = "float64") -> np.ndarray:
    """Zeros (layout.size,) aligned to a cache line, so that speed does not depend on where the buffer is allocated."""
    size = np.dtype(precision).itemsize
    raw = np.zeros(layout.size * size + CACHE_LINE, np.uint8)
    start = -raw.ctypes.data % CACHE_LINE
    return raw[start : start + layout.size * size].view(precision)


def new_buffer(fold: Fold, time_step_s: float) -> np.ndarray:
    """A buffer with the fixed fields filled and the state flat and at rest."""
    layout = Layout(fold.nx, fold.ny)
    buffer = empty_buffer(layout)
    fill(buffer, layout, 0, fold, time_step_s)
    return buffer


class Fixed(NamedTuple):
    """Views of the fixed fields of one fold in a buffer, by their names in layout.py.

    ``beam``: in a buffer of one fold the inverse of the implicit matrix (nx−2, nx−2), stored transposed; in a buffer of
    several folds its factors 1/D, a and c (3, nx−2).
    """

    G: np.ndarray
    medial: np.ndarray
    K_coup: np.ndarray
    inverse_density: np.ndarray
    width: np.ndarray
    column: np.ndarray
    beam_load: np.ndarray
    beam: np.ndarray


def fixed(buffer: np.ndarray, layout: Layout, place: int) -> Fixed:
    """The fixed fields of fold number ``place`` in ``buffer``."""
    first, nx, ny = layout.anterior, layout.nx, layout.ny

    rows = layout.K_coup

    def inner(name: str) -> np.ndarray:
        return _line(buffer, layout, name)[first + 1 : first + nx - 1, place]

    if layout.folds == 1:
        beam = buffer[layout.beam_inverse :].reshape(nx - 2, layout.columns)[:, : nx - 2]
    else:
        lines = layout.line("inv_D"), layout.line("beyond")
        beam = buffer[slice(*lines)].reshape(3, -1, layout.folds)[:, first + 1 : first + nx - 1, place]
    field = _field(buffer, layout, "G")[:, :, place]
    return Fixed(
        field,
        field[:, first : first + nx],
        buffer[rows : rows + ny * layout.folds].reshape(ny, layout.folds)[:, place],
        inner("inverse_density"),
        _line(buffer, layout, "width")[first + 1 : first + nx, place],
        _line(buffer, layout, "column")[:, place],
        inner("beam_load"),
        beam,
    )


def fill(buffer: np.ndarray, layout: Layout, place: int, fold: Fold, time_step_s: float) -> None:
    """Write the fixed fields of ``fold`` as fold number ``place`` of ``buffer``."""
    views = fixed(buffer, layout, place)
    views.G[:] = 1.0  # idle columns: far from contact
    views.column[:] = np.arange(layout.stride // layout.folds) - layout.anterior
    c = fold.coefficients
    views.medial[:] = fold.medial_plane_m
    views.K_coup[:] = fold.K_coup_pa_m
    views.inverse_density[:] = 1.0 / c.membrane_density_kg_m2
    views.width[:] = fold.dx
    views.width[-1] = 0.5 * fold.dx
    views.beam_load[:] = fold.beam_load_n_m / c.beam_density_kg_m
    M = np.eye(fold.nx - 2) - 0.25 * time_step_s**2 / c.beam_density_kg_m * fold.beam_matrix_n_m2
    views.beam[:] = np.linalg.inv(M).T if layout.folds == 1 else _factors(M)


def _factors(M: np.ndarray) -> np.ndarray:
    D, a, c = np.zeros((3, len(M)))
    D[:] = M.diagonal()
    factor(D, M[0, 1], M[0, 2], a, c)
    return np.array([1.0 / D, a, c])


def _field(buffer: np.ndarray, layout: Layout, name: str) -> np.ndarray:
    start = layout.field(name)
    return buffer[start : start + layout.ny * layout.stride].reshape(layout.ny, -1, layout.folds)


def _line(buffer: np.ndarray, layout: Layout, name: str) -> np.ndarray:
    start = layout.line(name)
    return buffer[start : start + layout.stride].reshape(-1, layout.folds)


def membranes(buffer: np.ndarray, layout: Layout, name: str = "w") -> np.ndarray:
    """A view (ny, nx, folds) of a field of the buffer, ends included."""
    return _field(buffer, layout, name)[:, layout.anterior : layout.anterior + layout.nx]


def beams(buffer: np.ndarray, layout: Layout, name: str = "w_b") -> np.ndarray:
    """A view (nx, folds) of a line of the buffer, ends included."""
    return _line(buffer, layout, name)[layout.anterior : layout.anterior + layout.nx]


def beyond(buffer: np.ndarray, layout: Layout) -> np.ndarray:
    """A view (lanes,): not 0 for a fold whose displacement passed LARGEST_DISPLACEMENT_M in the last steps."""
    start = layout.line("beyond")
    return buffer[start : start + layout.lanes]


def membrane(buffer: np.ndarray, fold: Fold, name: str = "w") -> np.ndarray:
    """A view (ny, nx) of a field of a buffer of one fold, ends included."""
    return membranes(buffer, Layout(fold.nx, fold.ny), name)[:, :, 0]


def beam(buffer: np.ndarray, fold: Fold, name: str = "w_b") -> np.ndarray:
    """A view (nx,) of a line of a buffer of one fold, ends included."""
    return beams(buffer, Layout(fold.nx, fold.ny), name)[:, 0]
