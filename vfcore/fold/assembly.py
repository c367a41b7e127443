"""The compiled assembler: from prestrained coefficients to the fields and numbers of a wall, and on into a buffer.

``wall_of`` fills what does not depend on the time step; ``place_wall`` and ``place_glottis`` write it where the step
reads it (fold/layout.py), with the beam's implicit matrix for the time step: its inverse for one glottis, its factors
for several. Runs, batches and gliding voices are all assembled here; a played voice needs it a hundred times a second.
Sizes and offsets are arguments, so that a new grid compiles nothing. Second order in dx and dy, as the step.
"""

from typing import NamedTuple

from vfcore.fold.material import fill_fields
from vfcore.fold.terms import WALL_NUMBERS, coupling, shear, tension
from vfcore.fold.terms.beam import beam_bands, beam_ends
from vfcore.kernels.banded import factor, invert
from vfcore.kernels.jit import jit

_STRETCH, _BEAM = WALL_NUMBERS.index("stretch_gain"), WALL_NUMBERS.index("beam_gain")


class Offsets(NamedTuple):
    """Sizes of a layout and offsets of one wall in it, in numbers; −1 for what its form does not have."""

    stride: int
    anterior: int
    glottises: int
    worked: int
    G: int
    inverse_mass: int
    tension_share: int
    shear: int
    shear_viscosity: int
    coupling: int
    coupling_damper: int
    contact: int
    contact_damper: int
    beam_load: int
    inverse_density: int
    inv_D: int
    a: int
    c: int
    width: int
    column: int
    K_coup: int
    law_gain: int
    law_A: int
    law_B: int
    law_C: int
    law_z: int
    law_alpha: int
    beam_inverse: int
    numbers: int
    wall_numbers: int


@jit
def wall_of(
    coefficients, strain, a_ta, theta_g, theta_0, convergence_tan, opening_tan, inferior_stiff, c, patches,
    fields, bands, numbers,
):  # fmt: skip
    """Fill ``fields`` (9, ny, nx), ``bands`` (7,) and ``numbers`` (len(WALL_NUMBERS),) of a wall.

    ``coefficients``: the first twelve fields of vfcore.larynx.tissue.coefficients.Coefficients. ``theta_g`` is the
    half-angle in the moment condition at the front, ``theta_0`` the rest angle, rad. ``c``: a
    vfcore.larynx.tissue.prestrain.Constants. ``patches`` (n, 8).
    """
    ny, nx = fields.shape[1:]
    lam, length, thickness, T, G_t, eta_t, rho_s, J, N_b, mu, M_c, rho_l = coefficients
    dx, dy = length / (nx - 1), thickness / (ny - 1)
    fill_fields(length, thickness, rho_s, G_t, eta_t, opening_tan, convergence_tan, inferior_stiff, c, patches, fields)
    ends = beam_ends(dx, mu, lam, M_c, c.K_r_a_n_m, c.K_r_p_n_m, theta_g, theta_0)
    values = beam_bands(dx, N_b, mu, ends)
    for k in range(len(values)):
        bands[k] = values[k]
    at = 0
    numbers[at], numbers[at + 1] = dy, 1.0 / rho_l
    at += 2
    for value in tension.membrane_numbers(strain, lam, T, dx, nx, c):
        numbers[at] = value
        at += 1
    for value in tension.axial_numbers(strain, a_ta, lam, dx, nx, c):
        numbers[at] = value
        at += 1
    for value in shear.numbers(G_t, eta_t, rho_s, J, lam, dy, c):
        numbers[at] = value
        at += 1
    for value in coupling.numbers(c):
        numbers[at] = value
        at += 1


@jit
def _put_law(buffer, o, to, gain, A, B, C, z_0, alpha):
    """Write the law of one slot."""
    buffer[o.law_gain + to], buffer[o.law_A + to], buffer[o.law_B + to] = gain, A, B
    buffer[o.law_C + to], buffer[o.law_z + to], buffer[o.law_alpha + to] = C, z_0, alpha


@jit
def place_wall(fields, bands, numbers, inv_rho_s, dt, o, at, work, buffer):
    """Write a wall as glottis number ``at`` of ``buffer``. ``o``: Offsets of the wall; ``work`` (3, nx−2): scratch."""
    ny, nx = fields.shape[1:]
    P, A, n, inv_rho_l = o.glottises, o.anterior, nx - 2, numbers[1]
    columns = o.stride // P
    for j in range(ny):
        row = j * o.stride + at
        for column in range(columns):
            buffer[o.G + row + column * P] = 1.0  # idle columns: far from contact
        for i in range(nx):
            buffer[o.G + row + (A + i) * P] = fields[0, j, i]
        if o.inverse_mass >= 0:
            for i in range(nx):
                to = row + (A + i) * P
                if 0 < i < nx - 1:
                    buffer[o.inverse_mass + to] = 1.0 / fields[1, j, i]
                buffer[o.tension_share + to] = fields[2, j, i]
                buffer[o.shear + to] = fields[3, j, i]
                buffer[o.shear_viscosity + to] = fields[4, j, i]
                buffer[o.coupling + to] = fields[5, j, i]
                buffer[o.coupling_damper + to] = fields[6, j, i]
        buffer[o.K_coup + j * P + at] = fields[5, j, 0]
    if o.law_gain >= 0:
        m, b = _STRETCH, _BEAM
        for j in range(ny):
            _put_law(
                buffer,
                o,
                j * P + at,
                numbers[m],
                numbers[m + 1],
                numbers[m + 2],
                numbers[m + 3],
                numbers[m + 4],
                numbers[m + 5],
            )
        to = ny * P + at
        _put_law(
            buffer, o, to, numbers[b], numbers[b + 1], numbers[b + 2], numbers[b + 3], numbers[b + 4], numbers[b + 5]
        )
        _put_law(buffer, o, to + P, numbers[b], 0.0, 0.0, numbers[b + 6], numbers[b + 7], numbers[b + 8])
    quarter = 0.25 * dt * dt * inv_rho_l
    D, a, c = work[0], work[1], work[2]
    for i in range(n):
        to = (A + 1 + i) * P + at
        buffer[o.beam_load + to] = 0.0
        buffer[o.inverse_density + to] = inv_rho_s
        D[i] = 1.0 - quarter * bands[1]
    D[0], D[n - 1] = 1.0 - quarter * bands[0], 1.0 - quarter * bands[2]
    buffer[o.beam_load + (A + 1) * P + at] = bands[5] * inv_rho_l
    buffer[o.beam_load + (A + n) * P + at] += bands[6] * inv_rho_l
    factor(D, -quarter * bands[3], -quarter * bands[4], a, c)
    if o.inv_D >= 0:
        for i in range(n):
            to = (A + 1 + i) * P + at
            buffer[o.inv_D + to], buffer[o.a + to], buffer[o.c + to] = 1.0 / D[i], a[i], c[i]
    else:
        invert(D, a, c, buffer[o.beam_inverse :], o.worked)
    for k in range(numbers.size):
        buffer[o.wall_numbers + k * P + at] = numbers[k]


@jit
def place_glottis(contact, contact_damper, width, numbers, o, at, buffer):
    """Write what both walls share as glottis number ``at``: ``contact`` and ``contact_damper`` (ny, nx) of the pair,
    ``width`` of a slice (m), and ``numbers`` (len(GLOTTIS_NUMBERS),).
    """
    ny, nx = contact.shape
    P, A = o.glottises, o.anterior
    if o.contact >= 0:
        for j in range(ny):
            for i in range(nx):
                to = j * o.stride + (A + i) * P + at
                buffer[o.contact + to], buffer[o.contact_damper + to] = contact[j, i], contact_damper[j, i]
    for i in range(1, nx):
        buffer[o.width + (A + i) * P + at] = width
    buffer[o.width + (A + nx - 1) * P + at] = 0.5 * width
    for column in range(o.stride // P):
        buffer[o.column + column * P + at] = column - A
    for k in range(numbers.size):
        buffer[o.numbers + k * P + at] = numbers[k]
