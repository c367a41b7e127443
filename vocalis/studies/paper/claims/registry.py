"""All claims, in the paper's order."""

from vocalis.studies.paper.claims import cost, cycle, maps, modal, pca, pitch, static
from vocalis.studies.paper.claims.claim import Claim

CLAIMS: dict[str, Claim] = {
    claim.key: claim for room in (static, modal, cycle, pitch, maps, pca, cost) for claim in room.CLAIMS
}
