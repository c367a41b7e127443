"""The tables of docs/model/ and docs/validation.md that need runs of the model, and their comparison.

The last printed digit may differ between machines, so tables are compared number by number. If the motion does not
repeat, it is chaotic and no digit is reproducible; such a run is listed by its state only.
"""

from tests.support.model_tables import table
from tests.support.separation_twin import TWINS, measured_voice
from vfcore.errors import DivergenceError
from vfcore.measures.catalogue import CATALOGUE
from vfcore.runs.one import simulate
from vfcore.runs.setup import prepare
from vfcore.spec.larynx import PAPER_LARYNX
from vfcore.spec.simulation import DEFAULT_STEP_S, PAPER_STEP_S, SECTION_TRAVEL_S, Activation, Model, Run, Simulation

PRINTED = {"speed_quotient": "1.52", "closed_quotient": "0.49"}  # by the paper, for the modal case
SHORT = {
    "fo_hz": ("$f_o$, Hz", 1, 1), "closed_quotient": ("CQ", 1, 3), "speed_quotient": ("SQ", 1, 2),
    "mean_flow_ml_s": ("$\\bar Q_g$, L/s", 1e-3, 2), "peak_area_mm2": ("peak area, mm²", 1, 1),
    "spl_lips_db": ("SPL at the lips, dB", 1, 1), "spl_30cm_db": ("SPL at 30 cm, dB", 1, 1),
    "contact_pressure_max_pa": ("$p_{\\mathrm{col,max}}$, kPa", 1e-3, 2), "contact_location": ("its $x/L$", 1, 2),
}  # fmt: skip
QUOTIENTS = ("fo_hz", "closed_quotient", "speed_quotient")
SOURCE = (*QUOTIENTS, "mean_flow_ml_s", "peak_area_mm2")


def modal() -> str:
    """Every measure of the modal case, with the value in the paper and the usual range in people."""
    report = simulate(Simulation()).report
    rows = []
    for spec in CATALOGUE:
        value, usual = report.measures[spec.key].value, spec.normal_range
        here = "not applicable" if value is None else f"{value:.{spec.decimals}f}"
        people = "" if usual is None else f"{usual.low:g}" + (f" to {usual.high:g}" if usual.high > usual.low else "")
        rows.append((f"`{spec.key}`", spec.unit, here, PRINTED.get(spec.key, ""), people, usual.who if usual else ""))
    return table(("measure", "unit", "here", "the paper", "usual", "in whom"), rows)


def runs(first: str, cases, columns) -> str:
    """One row for each (label, request); ``columns`` are keys of SHORT."""
    return table((first, "state", *(SHORT[key][0] for key in columns)), (_row(*case, columns) for case in cases))


def _row(label: str, request: Simulation, columns):
    try:
        report = simulate(request).report
    except DivergenceError:
        return (label, "diverges", *("–" for _ in columns))
    values = (report.measures[key].value for key in columns)
    known = report.state == "periodic"
    cells = (
        f"{value * SHORT[key][1]:.{SHORT[key][2]}f}" if known and value is not None else "–"
        for key, value in zip(columns, values, strict=True)
    )
    return (label, report.state, *cells)


def grid() -> str:
    cases = ((20, 10), (20, 20), (20, 40), (40, 10), (80, 10), (40, 20))
    return runs("$N_x × N_y$", ((f"{x} × {y}", Simulation(run=Run(nx=x, ny=y))) for x, y in cases), SOURCE)


def separation() -> str:
    """The modal case with the air pressure ending on nodes, and between nodes (twin)."""
    cases = [("on nodes, as in Vocalis", "nodes", ny) for ny in (10, 20)]
    cases += [("separation point between nodes", "separation", 10), ("closure between nodes", "closure", 10)]
    cases += [("both between nodes", "both", ny) for ny in (10, 20)]
    rows = []
    for label, kind, ny in cases:
        report = measured_voice(Simulation(run=Run(ny=ny)), TWINS[kind])
        values = (report.measures[key].value * SHORT[key][1] for key in SOURCE)
        rows.append((label, ny, *(f"{value:.{SHORT[key][2]}f}" for value, key in zip(values, SOURCE, strict=True))))
    return table(("the air pressure ends", "$N_y$", *(SHORT[key][0] for key in SOURCE)), rows)


def time_steps() -> str:
    steps = (DEFAULT_STEP_S, DEFAULT_STEP_S / 2, SECTION_TRAVEL_S, PAPER_STEP_S)
    rows = []
    for dt in steps:
        measures = simulate(Simulation(run=Run(time_step_s=dt))).report.measures
        f_o, cq, sq = (measures[key].value for key in QUOTIENTS)
        flow, contact = measures["mean_flow_ml_s"].value, measures["contact_pressure_max_pa"].value
        rows.append((f"{dt * 1e6:.3f}", f"{f_o:.3f}", f"{cq:.4f}", f"{sq:.3f}", f"{flow:.1f}", f"{contact:.0f}"))
    head = ("step, µs", "$f_o$, Hz", "CQ", "SQ", "$\\bar Q_g$, mL/s", "$p_{\\mathrm{col,max}}$, Pa")
    return table(head, rows)


def variants() -> str:
    cases = []
    for shear, gradient in (
        ("kelvin_voigt", "inferior_stiff"),
        ("kelvin_voigt", "superior_stiff"),
        ("rotation", "inferior_stiff"),
        ("rotation", "superior_stiff"),
    ):
        for ny in (10, 20):
            model, run = Model(shear=shear, coupling_gradient=gradient), Run(ny=ny)
            cases.append((f"`{shear}`, `{gradient}`, 20 × {ny}", Simulation(model=model, run=run)))
    return runs("shear, gradient, grid", cases, SOURCE)


def stretch() -> str:
    """The modal case with constant tension and with one that grows with the swing, at rising lung pressure."""
    cases = [
        (f"{p} Pa, `{form}`", Simulation(model=Model(stretch=form), subglottal_pressure_pa=p))
        for p in (400, 700, 1000, 1500, 2000)
        for form in ("linear", "finite")
    ]
    return runs("$P_s$, stretch", cases, (*SOURCE, "spl_30cm_db"))


def pressures() -> str:
    cases = ((f"{p}", Simulation(subglottal_pressure_pa=p)) for p in (150, 200, 300, 500, 1000, 2000))
    columns = (*SOURCE, "spl_lips_db", "spl_30cm_db")
    return runs("$P_s$, Pa", cases, columns)


def damping() -> str:
    changes = ({}, {"C_foun_pa_s": 50.0}, {"C_coup_pa_s_m": 100.0}, {"eta_m_pa_s": 5.0})
    names = [", ".join(f"`{name}` = {value:g}" for name, value in change.items()) for change in changes]
    folds = [PAPER_LARYNX.override(change) for change in changes]
    cases = ((name or "the paper's", Simulation(larynx=fold)) for name, fold in zip(names, folds, strict=True))
    return runs("damper changed", cases, (*SOURCE, "spl_30cm_db"))


def pca() -> str:
    columns = (*SOURCE, "contact_pressure_max_pa", "contact_location")
    cases = [(f"{a:g}", Simulation(activation=Activation(pca=a))) for a in (0, 0.1, 0.3, 0.5, 0.7, 0.8, 0.9, 1)]
    cases.append(("1, static start", Simulation(activation=Activation(pca=1), run=Run(start="static"))))
    return runs("PCA", cases, columns)


def closed() -> str:
    """Closed fraction of the modal case by several thresholds, by counting samples over whole cycles."""
    result = simulate(Simulation())
    area = result.arrays["glottal_area_m2"]
    period = result.provenance.sample_rate_hz / result.report.measures["fo_hz"].value
    cycles = area[-round(int(len(area) / 2 / period) * period) :]
    thresholds = (0.0, 1e-3, 0.02, 0.05, 0.1)
    rows = ((f"{100 * t:g} %", f"{(cycles <= t * cycles.max()).mean():.3f}") for t in thresholds)
    return table(("closed: area at or below, of the peak", "share of the cycle"), rows)


def shapes() -> str:
    """Posture and static shape along the four activation series that the paper shows, and of the modal case."""
    series = (
        ("LCA = IA", (0.2, 0.4, 0.6, 0.8, 1), lambda a: Activation(lca=a, ia=a, ct=0.1, ta=0)),
        ("TA", (0, 0.2, 0.4, 0.6, 0.8), lambda a: Activation(lca=0.5, ia=0.5, ct=0.1, ta=a)),
        ("CT", (0, 0.25, 0.5, 1), lambda a: Activation(lca=0.5, ia=0.5, ct=a, ta=0.2)),
        ("PCA", (0, 0.25, 0.5, 1), lambda a: Activation(lca=0.8, ia=0.8, ct=0.3, ta=0.5, pca=a)),
    )
    cases = [("modal", Activation())] + [(f"{name} {a:g}", make(a)) for name, values, make in series for a in values]
    rows = []
    for label, activation in cases:
        ready = prepare(Simulation(activation=activation))
        posture, static = ready.posture, ready.static
        lead = (static.w_m[-1] - static.w_m[0])[ready.glottis.nx // 2] * 1e3
        bulge = static.w_m[0].max() * 1e3
        rows.append(
            (
                label,
                f"{posture.strain:.3f}",
                f"{posture.raw_glottal_half_angle_rad:.3f}",
                f"`{static.closure.pattern}`",
                f"{static.closure.closed_fraction:.2f}",
                f"{static.closure.open_area_m2 * 1e6:.2f}",
                f"{bulge:.2f}",
                f"{lead:.2f}",
            )
        )
    head = (
        "case",
        "$\\bar\\varepsilon$",
        "raw $\\theta_g$, rad",
        "pattern",
        "closed fraction",
        "open area, mm²",
        "largest $w_m$, superior edge, mm",
        "inferior lead at mid-fold, mm",
    )
    return table(head, rows)


RUNS = {
    "modal": modal, "shapes": shapes, "closed": closed, "grid": grid,
    "separation": separation, "time steps": time_steps, "variants": variants,
    "stretch": stretch,
    "pressures": pressures, "damping": damping, "pca": pca,
}  # fmt: skip


def differences(old: str, new: str) -> list[tuple[str, str]]:
    """Cells that differ: other words, or numbers more than one unit of the last digit apart."""
    before, after = ([line.split(" | ") for line in text.splitlines()] for text in (old, new))
    if [len(line) for line in before] != [len(line) for line in after]:
        return [("different number of rows or columns", "")]
    pairs = ((a, b) for x, y in zip(before, after, strict=True) for a, b in zip(x, y, strict=True))
    return [(a, b) for a, b in pairs if a != b and not _same_number(a.strip("| "), b.strip("| "))]


def _same_number(a: str, b: str) -> bool:
    try:
        return abs(float(a) - float(b)) < 1.5 * 10.0 ** -len(a.partition(".")[2])
    except ValueError:
        return False
