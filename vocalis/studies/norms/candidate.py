"""Candidates of the calibration study, judged in full, and the rule that ranks them."""

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from vocalis.studies.norms.norms import FIFTEEN
from vocalis.studies.norms.shortfall import RANK, TRENDS, WANTED
from vocalis.studies.paper.bands import FAIL, PASS

#: Claims on shapes and closure patterns (S) and on the maps over CT and TA (A), which a set should not lose.
HELD = tuple(key for key in TRENDS if key[0] in "SA")
Verdicts = Mapping[str, str]


class Reference(NamedTuple):
    """The verdicts of the paper's constants with either coupling, by claim."""

    one_way: Verdicts
    two_way: Verdicts


class Candidate(NamedTuple):
    """A set judged in full: constants, activation, judged norms, total distance from the norms, verdicts on claims."""

    constants: dict[str, float]
    activation: dict[str, float]
    judged: dict[str, Any]
    distance: float
    claims: Verdicts
    reference: Reference

    @property
    def in_range(self) -> int:
        return self.judged["in_range"]

    @property
    def lost(self) -> list[str]:
        """Claims of HELD that are worse than with the paper's constants and two-way coupling."""
        return [key for key in HELD if RANK[self.claims[key]] > RANK[self.reference.two_way[key]]]

    @property
    def kept(self) -> list[str]:
        """Claims of HELD that are no worse than with the paper's constants and one-way coupling."""
        return [key for key in HELD if RANK[self.claims[key]] <= RANK[self.reference.one_way[key]]]

    @property
    def rank(self) -> tuple[float, ...]:
        """Sort key of the rule, best first."""
        return max(WANTED - self.in_range, 0), len(self.lost), -len(self.kept), -self.in_range, self.distance

    @property
    def merits(self) -> tuple[int, int, int]:
        return self.in_range, -len(self.lost), len(self.kept)

    def beats(self, other: "Candidate") -> bool:
        """Whether this candidate dominates the other in norms, claims lost and claims kept."""
        return self.merits != other.merits and all(a >= b for a, b in zip(self.merits, other.merits, strict=True))

    @property
    def plain(self) -> dict[str, Any]:
        """The candidate as plain values for the document of the study."""
        counts = {str(verdict): sum(found == verdict for found in self.claims.values()) for verdict in RANK}
        return {
            "constants": self.constants,
            "activation": self.activation,
            "in_range": self.in_range,
            "distance": round(self.distance, 3),
            "norms": {key: self.judged["norms"][key]["value"] for key in FIFTEEN},
            "score": counts,
            "lost": self.lost,
            "kept": len(self.kept),
            "failed": [key for key, verdict in self.claims.items() if verdict == FAIL],
            "short": [key for key, verdict in self.claims.items() if verdict not in (FAIL, PASS)],
        }


def front(found: Iterable[Candidate]) -> list[Candidate]:
    """The Pareto front in norms and claims, most norms first; among equals the first."""
    everyone = list(found)
    kept: dict[tuple, Candidate] = {}
    for candidate in everyone:
        if not any(other.beats(candidate) for other in everyone):
            kept.setdefault(candidate.merits, candidate)
    return [kept[key] for key in sorted(kept, reverse=True)]
