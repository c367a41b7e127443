"""The rows of the catalogue of measures, one entry per measure.

To add a measure, write a function of waves and cycles in another file of this folder, and one row here.
"""

from math import degrees

from vfcore.measures import contact, flow, glottis, level, perturbation, spectrum
from vfcore.measures.analysis import Analysis
from vfcore.measures.cycles import CLOSED_FRACTION
from vfcore.measures.measure import Missing
from vfcore.measures.measure_spec import MeasureSpec, Needs, NormalRange
from vfcore.measures.pitch import HIGHEST_RATE_HZ, LOWEST_RATE_HZ
from vfcore.measures.signals import SOUND, VIBRATION

AREA_WAVE, FLOW_WAVE = "glottal_area_m2", "glottal_flow_m3_s"
EFFICIENCY_SIGNALS = ("far_pressure_pa", "far_distance_m", FLOW_WAVE, "subglottal_pressure_pa")
# Which pressure a measure of the sound reads, if both are given.
FAR_FIRST, LIPS_FIRST = ("far_pressure_pa", "lip_pressure_pa"), ("lip_pressure_pa", "far_pressure_pa")
AREA = "minimum glottal area A_g,min(t)"
FLOW = "glottal flow Q_g(t)"
LIPS = "radiated pressure at the lips p_rad(t)"
FAR = "free-field pressure at 0.3 m, from the mouth flow as a simple source"
CONTACT = "contact pressure p_col(x, y, t)"
CONTACT_AREA = "contact area of the medial surface"
POSTURE = "posture"
PAPER = "Serry, Zañartu & Peterson (2026)"
HOLMBERG = "Holmberg, Hillman & Perkell (1988), approximate"
MEN = "men, normal effort"
PITCH_GROUP, LEVEL_GROUP, AREA_GROUP, FLOW_GROUP = "pitch", "level and efficiency", "glottal area", "glottal flow"
SPECTRUM_GROUP, PERTURBATION_GROUP, CONTACT_GROUP, POSTURE_GROUP = "spectrum", "perturbation", "contact", "posture"
CLOSED = (
    f"closed: area below {CLOSED_FRACTION:.1%} of the cycle's peak; 2 to 10 % would give up to 0.07 more closed time"
)
SLOPE = f"derivative low-passed at {flow.SLOPE_CUTOFF_HZ / 1e3:g} kHz (−3 dB, Gaussian)"
HARMONICS = "Hann window over the last half of the run, harmonics read at f_o and 2 f_o"


def _efficiency(a: Analysis) -> float | Missing:
    return level.efficiency(a.radiated_power_w, a.signals.number("subglottal_pressure_pa"), a.mean_flow_ml_s * 1e-6)


ROWS = (
    MeasureSpec(
        key="fo_hz", symbol="f_o", name="fundamental frequency", unit="Hz", group=PITCH_GROUP, signal=AREA, decimals=1,
        signals=(VIBRATION,),
        definition="Inverse mean cycle length. In a subharmonic voice the cycle is the whole repeating pattern, "
        "so f_o lies at a whole fraction of the visible rate.",
        formula="f_o = 1 / mean(T)",
        threshold=f"repeating patterns between {LOWEST_RATE_HZ:g} and {HIGHEST_RATE_HZ:g} Hz; see the phonation state",
        source="symbol and usage: Titze et al. (2015)",
        needs=Needs.CYCLES, compute=lambda a: a.fo_hz,
    ),
    MeasureSpec(
        key="spl_lips_db", symbol="SPL", name="sound pressure level at the lips", unit="dB", group=LEVEL_GROUP,
        signal=LIPS, decimals=1,
        signals=("lip_pressure_pa",),
        definition="Root-mean-square of the radiated pressure at the lips over the last half of the run, "
        "re 20 µPa. This is the paper's SPL; it is far above what a microphone at a distance reads.",
        formula="20 log₁₀(p_rms / 20 µPa)",
        source=PAPER,
        needs=Needs.PHONATION, compute=lambda a: level.sound_pressure_level_db(a.lip_rms_pa),
    ),
    MeasureSpec(
        key="spl_30cm_db", symbol="SPL₃₀", name="sound pressure level at 30 cm", unit="dB", group=LEVEL_GROUP,
        signal=FAR, decimals=1,
        signals=("far_pressure_pa", "far_distance_m"),
        definition="Root-mean-square of the free-field pressure at 0.3 m from the mouth over the last half of the "
        "run, re 20 µPa: the level a clinic would read.",
        formula="20 log₁₀(p_rms / 20 µPa)",
        source="Björklund & Sundberg (2016) for the distance and the expected level",
        normal_range=NormalRange(80.0, 80.0, "men, 10 cmH₂O subglottal pressure", "Björklund & Sundberg (2016)"),
        needs=Needs.PHONATION, compute=lambda a: level.sound_pressure_level_db(a.rms_at_30cm_pa),
    ),
    MeasureSpec(
        key="efficiency", symbol="η", name="vocal efficiency", unit="1", group=LEVEL_GROUP, signal=f"{FAR}; {FLOW}",
        decimals=6,
        signals=EFFICIENCY_SIGNALS,
        definition="Radiated power, of a simple source in free space, over the aerodynamic power "
        "(subglottal pressure times mean flow).",
        formula="(4π r² p_rms² / ρc) / (P_s Q̄)",
        source="Titze (1992)",
        needs=Needs.PHONATION, compute=_efficiency,
    ),
    MeasureSpec(
        key="efficiency_db", symbol="10 log η", name="vocal efficiency in decibels", unit="dB", group=LEVEL_GROUP,
        signal=f"{FAR}; {FLOW}", decimals=1,
        signals=EFFICIENCY_SIGNALS,
        definition="Vocal efficiency as a level.",
        formula="10 log₁₀ η",
        source="Titze (1992)",
        needs=Needs.PHONATION, compute=lambda a: level.decibels(_efficiency(a)),
    ),
    MeasureSpec(
        key="closed_quotient", symbol="CQ", name="closed quotient", unit="1", group=AREA_GROUP, signal=AREA, decimals=3,
        signals=(AREA_WAVE,),
        definition="Fraction of the cycle with the glottis closed; 0 where it never closes. The paper calls it "
        "closure quotient. It is neither the contact quotient nor the closing quotient.",
        formula="T_closed / T, mean over cycles",
        threshold=CLOSED,
        source=PAPER,
        normal_range=NormalRange(0.5, 0.5, "healthy adults, mean", "Mehta et al. (2010), after the paper"),
        needs=Needs.CYCLES, compute=lambda a: glottis.closed_quotient(a.open_phases),
    ),
    MeasureSpec(
        key="open_quotient", symbol="OQ", name="open quotient", unit="1", group=AREA_GROUP, signal=AREA, decimals=3,
        signals=(AREA_WAVE,),
        definition="Fraction of the cycle with the glottis open.",
        formula="OQ = 1 − CQ",
        threshold=CLOSED,
        source=HOLMBERG,
        normal_range=NormalRange(0.6, 0.6, f"{MEN}, from the flow", HOLMBERG),
        needs=Needs.CYCLES, compute=lambda a: glottis.open_quotient(a.open_phases),
    ),
    MeasureSpec(
        key="speed_quotient", symbol="SQ", name="speed quotient", unit="1", group=AREA_GROUP, signal=AREA, decimals=2,
        signals=(AREA_WAVE,),
        definition="Opening time over closing time of the open phase, divided at the area peak. With several openings "
        "in a cycle the open phase lasts from the first opening to the last closing; where the glottis never closes, "
        "from one area minimum to the next.",
        formula="(t_peak − t_open) / (t_close − t_peak), mean over cycles",
        threshold=CLOSED,
        source=PAPER,
        normal_range=NormalRange(1.3, 2.8, "normal modal voice", "Chen et al. (2002), after the paper"),
        needs=Needs.CYCLES, compute=lambda a: glottis.speed_quotient(a.open_phases),
    ),
    MeasureSpec(
        key="peak_area_mm2", symbol="A_max", name="peak glottal area", unit="mm²", group=AREA_GROUP, signal=AREA,
        decimals=2,
        signals=(AREA_WAVE,),
        definition="Largest minimum glottal area of a cycle.",
        formula="max A_g,min, mean over cycles",
        source=PAPER,
        needs=Needs.CYCLES, compute=lambda a: glottis.peak_area_mm2(a.area, a.area_peaks),
    ),
    MeasureSpec(
        key="glottal_gap_area_mm2", symbol="A_gap", name="glottal gap area", unit="mm²", group=AREA_GROUP, signal=AREA,
        decimals=2,
        signals=(AREA_WAVE,),
        definition="Smallest glottal area of a cycle: what never closes.",
        formula="min A_g,min, mean over cycles",
        source="usual in high-speed videoendoscopy",
        needs=Needs.CYCLES, compute=lambda a: glottis.gap_area_mm2(a.area, a.cycles),
    ),
    MeasureSpec(
        key="mean_flow_ml_s", symbol="Q̄", name="mean flow", unit="mL/s", group=FLOW_GROUP, signal=FLOW, decimals=0,
        signals=(FLOW_WAVE,),
        definition="Mean glottal flow over whole cycles; without phonation the steady leak. "
        "“DC flow” is used elsewhere for this and for the minimum flow alike.",
        formula="mean Q_g",
        source=HOLMBERG,
        normal_range=NormalRange(190.0, 190.0, MEN, HOLMBERG),
        needs=Needs.NOTHING, compute=lambda a: a.mean_flow_ml_s,
    ),
    MeasureSpec(
        key="ac_flow_ml_s", symbol="AC", name="AC flow", unit="mL/s", group=FLOW_GROUP, signal=FLOW, decimals=0,
        signals=(FLOW_WAVE,),
        definition="Largest minus smallest flow of a cycle.",
        formula="max Q_g − min Q_g, mean over cycles",
        source=HOLMBERG,
        normal_range=NormalRange(260.0, 260.0, MEN, HOLMBERG),
        needs=Needs.CYCLES, compute=lambda a: flow.ac_ml_s(a.flow_swing_m3_s),
    ),
    MeasureSpec(
        key="min_flow_ml_s", symbol="DC", name="minimum flow", unit="mL/s", group=FLOW_GROUP, signal=FLOW, decimals=0,
        signals=(FLOW_WAVE,),
        definition="Smallest flow of a cycle: the leak that remains at closure. "
        "“DC flow” is used elsewhere for this and for the mean flow alike.",
        formula="min Q_g, mean over cycles",
        source=HOLMBERG,
        needs=Needs.CYCLES, compute=lambda a: flow.min_ml_s(a.smallest_flow_m3_s),
    ),
    MeasureSpec(
        key="mfdr_l_s2", symbol="MFDR", name="maximum flow declination rate", unit="L/s²", group=FLOW_GROUP,
        signal=FLOW, decimals=0,
        signals=(FLOW_WAVE,),
        definition="Steepest fall of the flow in a cycle.",
        formula="−min dQ_g/dt, mean over cycles",
        threshold=SLOPE,
        source=HOLMBERG,
        normal_range=NormalRange(280.0, 280.0, MEN, HOLMBERG),
        needs=Needs.CYCLES, compute=lambda a: flow.mfdr_l_s2(a.flow_fall_m3_s2),
    ),
    MeasureSpec(
        key="naq", symbol="NAQ", name="normalised amplitude quotient", unit="1", group=FLOW_GROUP, signal=FLOW,
        decimals=3,
        signals=(FLOW_WAVE,),
        definition="AC flow over the steepest fall of the flow, in cycle lengths: small for pressed, "
        "large for breathy voice.",
        formula="(AC / |d_min|) / T, mean over cycles",
        threshold=SLOPE,
        source="Alku, Bäckström & Vilkman (2002)",
        needs=Needs.CYCLES,
        compute=lambda a: flow.naq(
            a.flow_swing_m3_s, a.flow_fall_m3_s2, a.cycles.periods / a.sample_rate_hz
        ),
    ),
    MeasureSpec(
        key="h1_h2_flow_db", symbol="H1–H2 (flow)", name="first minus second harmonic of the flow", unit="dB",
        group=SPECTRUM_GROUP, signal=FLOW, decimals=1,
        signals=(FLOW_WAVE,),
        definition="Level of the first harmonic of the glottal flow above the second.",
        formula="20 log₁₀(H1 / H2)",
        threshold=HARMONICS,
        source="Klatt & Klatt (1990)",
        needs=Needs.PERIODIC,
        compute=lambda a: spectrum.h1_h2_db(
            a.window(a.flow), a.fo_hz, a.sample_rate_hz
        ),
    ),
    MeasureSpec(
        key="h1_h2_sound_db", symbol="H1–H2 (sound)", name="first minus second harmonic of the radiated sound",
        unit="dB", group=SPECTRUM_GROUP, signal=FAR, decimals=1,
        signals=(SOUND,),
        definition="Level of the first harmonic of the radiated sound above the second, not corrected for formants, "
        "so it depends on the vowel.",
        formula="20 log₁₀(H1 / H2)",
        threshold=HARMONICS,
        source="Klatt & Klatt (1990)",
        needs=Needs.PERIODIC,
        compute=lambda a: spectrum.h1_h2_db(a.window(a.sound(*FAR_FIRST)), a.fo_hz, a.sample_rate_hz),
    ),
    MeasureSpec(
        key="cpp_db", symbol="CPP", name="cepstral peak prominence", unit="dB", group=SPECTRUM_GROUP, signal=FAR,
        decimals=1,
        signals=(SOUND,),
        definition="Height of the cepstral peak of the sound at the cycle length, above the straight line through the "
        "cepstrum. Values depend on the settings: compare only with the same ones.",
        formula="cepstrum(1/f_o) − regression line, dB, mean over frames",
        threshold=f"{spectrum.CPP_FRAME_S * 1e3:g} ms Hamming frames every {spectrum.CPP_HOP_S * 1e3:g} ms, "
        f"spectrum to {spectrum.CPP_BAND_HZ / 1e3:g} kHz, line fitted from {spectrum.CPP_LINE_FROM_S * 1e3:g} ms on, "
        f"peak sought from {spectrum.CPP_LOWEST_HZ:g} to {spectrum.CPP_HIGHEST_HZ:g} Hz",
        source="Hillenbrand, Cleveland & Erickson (1994)",
        needs=Needs.PHONATION,
        compute=lambda a: spectrum.cepstral_peak_prominence_db(
            a.sound(*FAR_FIRST)[a.signals.window_start :], a.sample_rate_hz
        ),
    ),
    MeasureSpec(
        key="jitter_percent", symbol="jitter", name="jitter (local)", unit="%", group=PERTURBATION_GROUP, signal=AREA,
        decimals=2,
        signals=(VIBRATION,),
        definition="Mean difference between the lengths of neighbouring cycles, relative to the mean length. "
        "Given for irregular voices only; above about 5 % it no longer ranks voices.",
        formula="100 · mean|T_i − T_i+1| / mean T",
        threshold="cycle lengths from opening to opening (from minimum to minimum where the glottis never closes)",
        source="Titze (1995)",
        needs=Needs.IRREGULAR, compute=lambda a: perturbation.jitter_percent(a.cycle_instants),
    ),
    MeasureSpec(
        key="shimmer_percent", symbol="shimmer", name="shimmer (local)", unit="%", group=PERTURBATION_GROUP,
        signal=LIPS, decimals=2,
        signals=(SOUND,),
        definition="Mean difference between the peak-to-peak pressures of neighbouring cycles, relative to their mean. "
        "Given for irregular voices only.",
        formula="100 · mean|a_i − a_i+1| / mean a",
        source="Titze (1995)",
        needs=Needs.IRREGULAR,
        compute=lambda a: perturbation.shimmer_percent(a.sound(*LIPS_FIRST), a.cycles),
    ),
    MeasureSpec(
        key="hnr_db", symbol="HNR", name="harmonics-to-noise ratio", unit="dB", group=PERTURBATION_GROUP, signal=LIPS,
        decimals=1,
        signals=(SOUND,),
        definition="Energy of the sound that repeats from cycle to cycle over the energy that does not. "
        "Given for irregular voices only.",
        formula="10 log₁₀(r / (1 − r)), r the autocorrelation peak at the cycle length",
        source="Boersma (1993)",
        needs=Needs.IRREGULAR,
        compute=lambda a: perturbation.harmonics_to_noise_db(
            a.window(a.sound(*LIPS_FIRST)), a.repetition.cycle
        ),
    ),
    MeasureSpec(
        key="contact_pressure_max_pa", symbol="p_col,max", name="maximum contact pressure", unit="Pa",
        group=CONTACT_GROUP, signal=CONTACT, decimals=0,
        signals=(VIBRATION, "contact_pressure_max_pa"),
        definition="Largest contact pressure over the medial surface and the cycle (from area peak to area peak); "
        "0 where the folds never touch.",
        formula="max over x, y, t of p_col, mean over cycles",
        source=PAPER,
        normal_range=NormalRange(500.0, 5000.0, "canine hemilarynx, mid-fold", "Jiang & Titze (1994)"),
        needs=Needs.CYCLES,
        compute=lambda a: contact.pressure_max_pa(a.contact_pressure, a.contact_peaks),
    ),
    MeasureSpec(
        key="contact_location", symbol="x/L", name="location of the maximum contact pressure", unit="1",
        group=CONTACT_GROUP, signal=CONTACT, decimals=2,
        signals=(VIBRATION, "contact_pressure_max_pa", "contact_location"),
        definition="Where along the fold the maximum contact pressure sits: 0 anterior, 1 posterior.",
        formula="x/L at max p_col, mean over cycles with contact",
        source=PAPER,
        needs=Needs.CYCLES,
        compute=lambda a: contact.location(a.signals.wave("contact_location"), a.contact_peaks),
    ),
    MeasureSpec(
        key="contact_impulse_pa_s", symbol="J_col", name="contact impulse", unit="Pa·s", group=CONTACT_GROUP,
        signal=CONTACT, decimals=2,
        signals=(VIBRATION, "contact_pressure_max_pa"),
        definition="Time integral over a cycle of the largest contact pressure on the medial surface; "
        "negative pressures at separation are left out.",
        formula="∫ max(0, max over x, y of p_col) dt over a cycle, mean over cycles",
        source="defined here",
        needs=Needs.CYCLES,
        compute=lambda a: contact.impulse_pa_s(
            a.contact_pressure, a.contact_pressure_cycles, a.sample_rate_hz
        ),
    ),
    MeasureSpec(
        key="contact_area_mm2", symbol="A_col", name="contact area", unit="mm²", group=CONTACT_GROUP,
        signal=CONTACT_AREA, decimals=1,
        signals=(VIBRATION, "contact_area_m2"),
        definition="Largest area of the medial surface in contact in a cycle.",
        formula="max A_col, mean over cycles",
        source="defined here",
        needs=Needs.CYCLES, compute=lambda a: contact.area_mm2(a.largest_contact_m2),
    ),
    MeasureSpec(
        key="contact_area_fraction", symbol="A_col / Lb", name="largest share of the medial surface in contact",
        unit="1", group=CONTACT_GROUP, signal=CONTACT_AREA, decimals=3,
        signals=(VIBRATION, "contact_area_m2", "medial_area_m2"),
        definition="Largest contact area of a cycle over the area of the medial surface.",
        formula="max A_col / (L b), mean over cycles",
        source="defined here",
        needs=Needs.CYCLES,
        compute=lambda a: contact.area_fraction(a.largest_contact_m2, a.signals.number("medial_area_m2")),
    ),
    MeasureSpec(
        key="contact_quotient", symbol="CQ_contact", name="contact quotient", unit="1", group=CONTACT_GROUP,
        signal=CONTACT_AREA, decimals=3,
        signals=(VIBRATION, "contact_area_m2"),
        definition="Fraction of the cycle in which the contact area exceeds a quarter of its largest value; 0 where "
        "the folds never touch. What an electroglottograph would see, not the closed quotient.",
        formula="T(A_col > 0.25 max A_col) / T, mean over cycles",
        threshold=f"{contact.CONTACT_FRACTION:.0%} of the cycle's largest contact area",
        source="Orlikoff (1991); why it is not CQ: Herbst et al. (2017)",
        needs=Needs.CYCLES,
        compute=lambda a: contact.contact_quotient(
            a.contact_area, a.largest_contact_m2, a.contact_area_cycles
        ),
    ),
    MeasureSpec(
        key="strain", symbol="ε̄", name="strain of the folds", unit="1", group=POSTURE_GROUP, signal=POSTURE, decimals=3,
        signals=("strain",),
        definition="Length change of the folds relative to their resting length, set by the muscles.",
        formula="L / L_0 − 1",
        source=PAPER,
        needs=Needs.NOTHING, compute=lambda a: float(a.signals.number("strain")),
    ),
    MeasureSpec(
        key="length_mm", symbol="L", name="length of the folds", unit="mm", group=POSTURE_GROUP, signal=POSTURE,
        decimals=2,
        signals=("length_m",),
        definition="Length of the membranous folds in this posture.",
        formula="L = L_0 (1 + ε̄)",
        source=PAPER,
        needs=Needs.NOTHING, compute=lambda a: float(a.signals.number("length_m") * 1e3),
    ),
    MeasureSpec(
        key="glottal_half_angle_deg", symbol="θ_g", name="glottal half-angle", unit="°", group=POSTURE_GROUP,
        signal=POSTURE, decimals=2,
        signals=("glottal_half_angle_rad",),
        definition="Angle of one fold's resting edge to the midline; 0 when adducted.",
        formula="θ_g",
        source=PAPER,
        needs=Needs.NOTHING, compute=lambda a: degrees(a.signals.number("glottal_half_angle_rad")),
    ),
    MeasureSpec(
        key="gap_mm", symbol="2 L tan θ_g", name="posterior gap", unit="mm", group=POSTURE_GROUP, signal=POSTURE,
        decimals=2,
        signals=("gap_m",),
        definition="Full distance between the posterior ends of the two folds at rest, for the vibrating fold's L.",
        formula="2 L tan θ_g",
        source=PAPER,
        needs=Needs.NOTHING, compute=lambda a: float(a.signals.number("gap_m") * 1e3),
    ),
)  # fmt: skip
