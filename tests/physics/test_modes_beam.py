"""The beam alone against textbook solutions: string, hinged, clamped and elastic ends.

Roots of Euler–Bernoulli beams: Rao, Mechanical Vibrations, table of beam boundary conditions.
"""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from vfcore.fold.assemble import beam_operator
from vfcore.fold.constants import FoldConstants
from vfcore.fold.terms.beam import beam_bands, beam_ends
from vfcore.larynx.tissue.coefficients import coefficients

POSED = coefficients(0.057, 0.4, FoldConstants())
CLAMPED_ROOTS = (4.730041, 7.853205, 10.995608)  # cos βL cosh βL = 1
CLAMPED_HINGED_ROOTS = (3.926602, 7.068583, 10.210176)  # tan βL = tanh βL
FREE_ENDS = {"K_r_a_n_m": 0.0, "K_r_p_n_m": 0.0}


def operator(nx, c, constants, theta_g):
    """Matrix (nx−2, nx−2), N/m², and load (nx−2,), N/m, of the beam at a rest angle of 0.254 rad."""
    dx, mu = c.length_m / (nx - 1), c.bending_stiffness_n_m2
    springs = constants.K_r_a_n_m, constants.K_r_p_n_m
    ends = beam_ends(dx, mu, c.stretch_ratio, c.prestress_moment_n_m, *springs, theta_g, 0.254)
    return beam_operator(np.array(beam_bands(dx, c.beam_tension_n, mu, ends)), nx - 2)


def frequencies(nx, c, **constants):
    """Natural angular frequencies of the beam alone, rad/s, ascending."""
    matrix, _ = operator(nx, c, FoldConstants(**constants), 0.0)
    return np.sqrt(np.sort(np.linalg.eigvals(-matrix / c.beam_density_kg_m).real))


def bending_only(stiffness=POSED.bending_stiffness_n_m2):
    return replace(POSED, beam_tension_n=0.0, bending_stiffness_n_m2=stiffness)


def of_roots(roots, c):
    """ω = β² √(μ/ρ)."""
    return (np.array(roots) / c.length_m) ** 2 * np.sqrt(c.bending_stiffness_n_m2 / c.beam_density_kg_m)


def test_hinged_ends_give_sines_under_tension_and_bending():
    n = np.arange(1, 4) * np.pi / POSED.length_m
    exact = np.sqrt((POSED.beam_tension_n * n**2 + POSED.bending_stiffness_n_m2 * n**4) / POSED.beam_density_kg_m)
    coarse, fine = (frequencies(nx, POSED, **FREE_ENDS)[:3] for nx in (41, 81))
    assert fine == pytest.approx(exact, rel=2e-3)
    assert np.log2((coarse - exact) / (fine - exact)) == pytest.approx(2, abs=0.05)


def test_without_bending_the_beam_is_a_string():
    string = replace(POSED, bending_stiffness_n_m2=1e-12)
    exact = np.arange(1, 4) * np.pi / POSED.length_m * np.sqrt(POSED.beam_tension_n / POSED.beam_density_kg_m)
    assert frequencies(81, string, **FREE_ENDS)[:3] == pytest.approx(exact, rel=2e-3)


def test_stiff_ends_clamp_the_beam():
    c = bending_only(1e-9)  # against springs of 10 N·m, clamped to a part in a million
    exact = of_roots(CLAMPED_ROOTS, c)
    coarse, fine = (frequencies(nx, c, K_r_a_n_m=10.0, K_r_p_n_m=10.0)[:3] for nx in (41, 81))
    assert fine == pytest.approx(exact, rel=6e-3)
    assert np.log2((coarse - exact) / (fine - exact)) == pytest.approx(2, abs=0.1)


@pytest.mark.parametrize("stiff_end", ["K_r_a_n_m", "K_r_p_n_m"])
def test_one_stiff_spring_clamps_its_end_only(stiff_end):
    c = bending_only(1e-9)
    found = frequencies(81, c, **(FREE_ENDS | {stiff_end: 10.0}))[:3]
    assert found == pytest.approx(of_roots(CLAMPED_HINGED_ROOTS, c), rel=4e-3)


def test_a_spring_of_the_papers_size_at_both_ends_gives_the_roots_of_the_exact_condition():
    """κ = K_r λ^{3/2} L/μ at both ends, no tension: root of the symmetric mode 2β (cos·sinh + sin·cosh) + 4κ … .

    For w = A cos(β(x − L/2)) + B cosh(β(x − L/2)) the end conditions w = 0 and μ w'' = K w' (outwards) leave
    cosh(h)·(β cos(h) + k sin(h)) + cos(h)·(β cosh(h) + k sinh(h)) = 0 with h = βL/2, k = K/μ.
    """
    c = bending_only()
    spring = 0.01 * c.stretch_ratio**1.5 / c.bending_stiffness_n_m2

    def condition(h):
        beta = 2 * h / c.length_m
        return np.cosh(h) * (beta * np.cos(h) + spring * np.sin(h)) + np.cos(h) * (
            beta * np.cosh(h) + spring * np.sinh(h)
        )

    h = brentq(condition, np.pi / 2 + 1e-6, 4.730041 / 2 - 1e-9)
    exact = of_roots([2 * h], c)
    found = frequencies(161, c, K_r_a_n_m=0.01, K_r_p_n_m=0.01)[:1]
    assert found == pytest.approx(exact, rel=5e-4)
    assert of_roots([np.pi], c) < exact < of_roots(CLAMPED_ROOTS[:1], c)


def test_end_moments_bend_a_hinged_beam_without_tension_into_a_parabola():
    """M̄ at both ends, no rotational springs: μ w'' = −M̄ all along, so w = M̄ x (L − x)/2μ: medial for M̄ > 0."""
    c = bending_only()
    matrix, load = operator(20, c, FoldConstants(**FREE_ENDS), 0.0)
    x = np.linspace(0, c.length_m, 20)[1:-1]
    exact = c.prestress_moment_n_m * x * (c.length_m - x) / (2 * c.bending_stiffness_n_m2)
    assert np.linalg.solve(-matrix, load) == pytest.approx(exact, rel=1e-9)


def test_the_anterior_spring_acts_at_the_anterior_end_only():
    """At θ_g = θ_0 without prestress nothing loads the beam; a wider glottis turns the anterior end outwards."""
    calm = replace(POSED, prestress_moment_n_m=0.0)
    constants = FoldConstants()
    _, load = operator(20, calm, constants, 0.254)
    assert not load.any()
    matrix, load = operator(20, calm, constants, 0.154)
    shape = np.linalg.solve(-matrix, load)
    assert load[0] != 0 and not load[1:].any()
    assert abs(shape[:9]).max() > abs(shape[9:]).max()
    matrix, wider = operator(20, calm, constants, 0.354)
    assert wider == pytest.approx(-load, rel=1e-9)
