"""All claims, in the paper's order."""

from vocalis_paper import claims_cost, claims_cycle, claims_maps, claims_modal, claims_pca, claims_pitch, claims_static
from vocalis_paper.claim import Claim

CLAIMS: dict[str, Claim] = {
    claim.key: claim
    for room in (claims_static, claims_modal, claims_cycle, claims_pitch, claims_maps, claims_pca, claims_cost)
    for claim in room.CLAIMS
}
