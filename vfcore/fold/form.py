"""The form of a step: what the compiled loop of a fold is made for. One frozen value, the one key of every kernel."""

from dataclasses import dataclass, replace

#: Numbers per SIMD vector: 512 bits. On processors with 256-bit vectors these are two, which fills the pipelines.
LANES = {"float64": 8, "float32": 16}


@dataclass(frozen=True)
class StepForm:
    """Grid, walls, equations and arithmetic of a step.

    ``nx``, ``ny``: nodes, ends included. ``walls``: 1 for a fold and its mirror image, 2 for a left and a right fold.
    ``rotation``: shear by the rotation equation. ``finite``: tension that grows with the swing. ``patched``: material
    that varies over the surface. ``coupled``: the airways act back. ``many``: one glottis per element of a SIMD vector
    instead of one alone. ``precision``: "float64", or "float32" for many.
    """

    nx: int
    ny: int
    walls: int = 1
    rotation: bool = False
    finite: bool = False
    patched: bool = False
    coupled: bool = False
    many: bool = False
    precision: str = "float64"

    @property
    def lanes(self) -> int:
        """Numbers per vector."""
        return LANES[self.precision]

    @property
    def glottises(self) -> int:
        """Glottises side by side in a buffer."""
        return self.lanes if self.many else 1

    def covering(self, other: "StepForm") -> "StepForm":
        """The form that can march what either of two forms of the same grid and equations can."""
        return replace(self, walls=max(self.walls, other.walls), patched=self.patched or other.patched)

    @property
    def record(self) -> tuple[str, ...]:
        """Names of the columns of a record: one row per recorded step."""
        return RECORD if self.walls == 1 else RECORD + SIDE_RECORD


#: Columns of every record.
RECORD = (
    "glottal_area_m2",
    "glottal_flow_m3_s",
    "contact_pressure_max_pa",
    "contact_column",
    "contact_area_m2",
    "inlet_pressure_pa",
    "outlet_pressure_pa",
)
#: Further columns of two different walls: the distance of each fold's edge from the midline at mid-length, smallest
#: over the thickness, positive lateral: what a kymogram shows of each side.
SIDE_RECORD = ("left_edge_m", "right_edge_m")
