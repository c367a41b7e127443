"""Slow, obvious twins of the vocal tract: tubes and circuit elements in time, and chain matrices in frequency.

There are no reflection and no filter coefficients: junctions balance pressure and flow through impedances, and the lips
are a resistance parallel to an inertance, advanced by the trapezoidal rule.
"""

import numpy as np


def radiation_elements(end_area, rho, c):
    """R and L of a piston in a baffle (Flanagan 1972)."""
    Z = rho * c / end_area
    radius = np.sqrt(end_area / np.pi)
    return 128 * Z / (9 * np.pi**2), 8 * radius * Z / (3 * np.pi * c)


def stepped_twin(flow, areas, section_length, rho=1.14, c=350.0, attenuation=3.8e-3, open_end=False):
    """Lip pressure, Pa, and mouth flow, m³/s, for a glottal flow sampled once per section travel."""
    areas = np.asarray(areas, dtype=float)
    Z = rho * c / areas
    loss = 1 - attenuation * section_length / np.sqrt(areas)
    R, L = radiation_elements(areas[-1], rho, c)
    half = section_length / c / 2
    f, b = np.zeros(areas.size), np.zeros(areas.size)
    p, i_L = 0.0, 0.0
    lip_pressure, mouth_flow = [], []
    for q in flow:
        F, B = loss * f, loss * b
        # the pressure of a junction is that of two sources 2F and 2B behind Z_i and Z_{i+1}
        p_j = 2 * (F[:-1] / Z[:-1] + B[1:] / Z[1:]) / (1 / Z[:-1] + 1 / Z[1:])
        if open_end:
            p = 0.0
            u = 2 * F[-1] / Z[-1]
        else:
            p_old = p
            p = (2 * F[-1] / Z[-1] - i_L - half / L * p_old) / (1 / Z[-1] + 1 / R + half / L)
            i_L += half / L * (p + p_old)
            u = p / R + i_L
        f = np.concatenate([[B[0] + Z[0] * q], p_j - B[1:]])
        b = np.concatenate([p_j - F[:-1], [p - F[-1]]])
        lip_pressure.append(p)
        mouth_flow.append(u)
    return np.array(lip_pressure), np.array(mouth_flow)


def chain_response(freqs, areas, section_length, rho=1.14, c=350.0, attenuation=3.8e-3, warped=False):
    """Lip pressure per glottal flow, one 2×2 matrix product per frequency.

    ``warped``: radiation impedance at the frequency warped by the bilinear transform of the section travel time.
    """
    R, L = radiation_elements(areas[-1], rho, c)
    travel = section_length / c
    response = []
    for f in freqs:
        omega = 2 * np.pi * f
        s = 1j * (2 / travel * np.tan(omega * travel / 2) if warped else omega)
        Z_rad = s * L * R / (R + s * L)
        chain = np.eye(2, dtype=complex)
        for area in areas:
            Z = rho * c / area
            gamma = 1j * omega * travel - np.log(1 - attenuation * section_length / np.sqrt(area))
            chain = chain @ np.array([[np.cosh(gamma), Z * np.sinh(gamma)], [np.sinh(gamma) / Z, np.cosh(gamma)]])
        response.append(Z_rad / (chain[1, 0] * Z_rad + chain[1, 1]))
    return np.array(response)
