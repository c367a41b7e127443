"""T1: what a run costs (the paper's "Simulation setup")."""

from vocalis.studies.paper.bands import PASS, Part, below, conclude
from vocalis.studies.paper.claims.claim import Claim, ClaimOutcome
from vocalis.studies.paper.evidence import Timing

LIMIT_S = 60.0


def fast_enough(timing: Timing) -> ClaimOutcome:
    paper, own = (wall / timing.simulated_s for wall in (timing.wall_s_paper_step, timing.wall_s_own_step))
    return conclude(
        Part(
            "wall time per simulated second, paper's step",
            paper,
            "s",
            f"1 s of voice takes {paper:.3g} s at the paper's time step",
            below(paper, LIMIT_S, 2 * LIMIT_S),
        ),
        Part("wall time per simulated second, own step", own, "s", f"{own:.3g} s at the default step", PASS),
    )


CLAIMS = (
    Claim(
        key="T1",
        title="One second of phonation in under a minute",
        needs=("timing",),
        picture="number",
        check=fast_enough,
        paper_says="A typical run, 1 s on the 20 × 10 grid with a step of 1.7857 µs, takes less than a minute on a "
        "laptop (Simulation setup).",
        definition="Wall time of one warm call of vfcore.simulate for the modal case on the paper's grid and step, "
        f"per simulated second. Pass: below {LIMIT_S:g} s. Deviation: below {2 * LIMIT_S:g} s, which another machine "
        "would explain. Fail: longer. The time at the default step is reported as well.",
    ),
)
