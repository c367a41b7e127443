"""Which signals each measure needs, and what is measured on an area, a flow or a sound alone."""

from dataclasses import fields, replace
from itertools import chain, combinations

import numpy as np
import pytest

import vfcore
from tests.support.synthetic_waves import MM2, alternating, raised_pulse, signals_from, steady_phase, times
from vfcore.airways.impulse_response import radiate
from vfcore.airways.tract import vowel_tract
from vfcore.errors import ParameterError
from vfcore.measures import CATALOGUE, Signals, measure_all
from vfcore.measures.analysis import Analysis
from vfcore.measures.measure_spec import Needs
from vfcore.measures.phonation import STATES
from vfcore.measures.signals import ALTERNATIVES, NUMBERS, SOUND, VIBRATION, WAVES, Sound, with_alternatives

RATE_HZ, FO_HZ = 28_000.0, 149.6
T = times(0.8, RATE_HZ)
PULSES = 20 * MM2 * raised_pulse(steady_phase(T, FO_HZ), 0.506, 1.52)
WHOLE = {
    "periodic": signals_from(PULSES, RATE_HZ),
    "irregular": signals_from(PULSES * (1 + 0.4 * np.sin(2 * np.pi * 0.382 * FO_HZ * T)), RATE_HZ),
}
GIVES = {
    "periodic": {Needs.NOTHING, Needs.PHONATION, Needs.CYCLES, Needs.PERIODIC},
    "irregular": {Needs.NOTHING, Needs.PHONATION, Needs.CYCLES, Needs.IRREGULAR},
}
#: Signals that are given or left out one with the other.
GROUPS = (
    ("glottal_area_m2",),
    ("glottal_flow_m3_s", "subglottal_pressure_pa"),
    ("lip_pressure_pa",),
    ("far_pressure_pa", "far_distance_m"),
    ("contact_pressure_max_pa", "contact_location"),
    ("contact_area_m2",),
    ("length_m", "strain", "glottal_half_angle_rad", "gap_m", "medial_area_m2"),
)
SUBSETS = list(chain.from_iterable(combinations(GROUPS, k) for k in range(len(GROUPS) + 1)))


def only(whole: Signals, names) -> Signals:
    return replace(whole, **dict.fromkeys({*WAVES, *NUMBERS} - set(names)))


def choices(spec) -> list[set[str]]:
    """The least sets of signals that a measure declares: one for each member of its alternatives."""
    found = [set()]
    for name in spec.signals:
        found = [one | {member} for one in found for member in ALTERNATIVES.get(name, (name,))]
    return found


def value_and_reason(signals: Signals, key: str):
    measure = measure_all(signals, [key]).measures[key]
    return measure.value, measure.reason


@pytest.mark.parametrize("rate_hz", [1e-300, 1e-3, 1.0, 19.9, 99.9, 0.0, -1.0])
def test_a_rate_that_samples_no_voice_is_refused(rate_hz):
    with pytest.raises(ParameterError, match="signals.sample_rate_hz: .* at least 100 Hz"):
        Signals(rate_hz, glottal_area_m2=PULSES)


@pytest.mark.parametrize("rate_hz", [100.0, 101.7, 250.0, 1e9])
@pytest.mark.parametrize("samples", [16, 100, 3000])
def test_any_other_rate_is_measured(rate_hz, samples):
    assert vfcore.measure(Signals(rate_hz, glottal_area_m2=PULSES[:samples])).state in STATES


def test_a_wave_may_be_a_list_of_numbers():
    found, wanted = (vfcore.measure(Signals(RATE_HZ, glottal_area_m2=wave)) for wave in (PULSES.tolist(), PULSES))
    assert found == wanted and found.measures["fo_hz"].value == pytest.approx(FO_HZ, rel=1e-3)


@pytest.mark.parametrize("wave", [["a"] * 20, [[1.0], 2.0] * 10, [None] * 20, {"a": 1}])
def test_a_wave_that_is_no_row_of_numbers_is_refused(wave):
    with pytest.raises(ParameterError, match="signals.glottal_area_m2"):
        Signals(RATE_HZ, glottal_area_m2=wave)


def test_every_signal_that_is_declared_is_one():
    assert {field.name for field in fields(Signals)} >= {*WAVES, *NUMBERS}
    for spec in CATALOGUE:
        assert spec.signals and set(spec.signals) <= {*WAVES, *NUMBERS, *ALTERNATIVES}, spec.key
    assert {name for spec in CATALOGUE for one in choices(spec) for name in one} == {*WAVES, *NUMBERS}
    assert all(row["signals"] == list(CATALOGUE[row["key"]].signals) for row in CATALOGUE.as_rows())


@pytest.mark.parametrize("state", WHOLE)
@pytest.mark.parametrize("subset", SUBSETS, ids=lambda subset: "+".join(group[0] for group in subset) or "nothing")
def test_a_value_is_there_exactly_when_its_signals_are_and_the_state_allows_it(state, subset):
    names = set(chain.from_iterable(subset))
    signals = only(WHOLE[state], names)
    report, given = measure_all(signals), with_alternatives(names)
    assert report.state == (state if VIBRATION in given else "none")
    for spec in CATALOGUE:
        measure = report.measures[spec.key]
        there = given.issuperset(spec.signals)
        assert (measure.value is not None) == (there and spec.needs in GIVES[state]), (spec.key, measure)
        assert (measure.reason or "").startswith("Needs ") == (not there), (spec.key, measure)
    assert set(CATALOGUE.measurable(signals)) == {spec.key for spec in CATALOGUE if given.issuperset(spec.signals)}


@pytest.mark.parametrize("key", CATALOGUE.keys())
def test_the_declared_signals_are_all_needed_and_enough(key):
    spec = CATALOGUE[key]
    state = "irregular" if spec.needs is Needs.IRREGULAR else "periodic"
    whole = WHOLE[state]
    expected, _ = value_and_reason(whole, key)
    for names in choices(spec):
        value, reason = value_and_reason(only(whole, names), key)
        assert reason is None
        if "glottal_area_m2" in names or spec.needs is Needs.NOTHING and not names & set(WAVES):
            assert value == expected
        elif state == "periodic":
            assert value == pytest.approx(expected, rel=2e-3, abs=1e-9), names
        else:  # cycles of an irregular voice are cut elsewhere, or another wave is read
            assert value == pytest.approx(expected, rel=0.1, abs=2.0), names
    for name in spec.signals:
        members = set(ALTERNATIVES.get(name, (name,)))
        lacking = only(whole, {*WAVES, *NUMBERS} - members)
        value, reason = value_and_reason(lacking, key)
        assert value is None and reason.startswith("Needs ") and reason.endswith(" not given."), (name, reason)
        with pytest.raises(LookupError):
            spec.compute(Analysis(lacking))


def test_the_reason_names_what_is_missing():
    signals = Signals.of_sound(WHOLE["periodic"].far_pressure_pa, RATE_HZ)
    measures = measure_all(signals).measures
    assert measures["closed_quotient"].reason == "Needs the glottal area, which is not given."
    assert measures["efficiency"].reason == (
        "Needs the distance of the microphone, the glottal flow and the subglottal pressure, which are not given."
    )


@pytest.mark.parametrize(("names", "judged"), [
    ({*WAVES}, "glottal_area_m2"),
    ({*WAVES} - {"glottal_area_m2"}, "glottal_flow_m3_s"),
    ({"lip_pressure_pa", "far_pressure_pa", "contact_area_m2"}, "far_pressure_pa"),
    ({"lip_pressure_pa"}, "lip_pressure_pa"),
    ({"contact_area_m2", "strain"}, None),
])  # fmt: skip
def test_the_report_says_which_signal_was_judged(names, judged):
    report = measure_all(only(WHOLE["periodic"], names))
    assert report.judged == judged
    assert report.state == ("none" if judged is None else "periodic")
    words = {"glottal_flow_m3_s": "glottal flow", "far_pressure_pa": "sound", "lip_pressure_pa": "sound"}
    if judged in words:
        assert report.explanation.endswith(f" Judged on the {words[judged]}.")
    if judged is None:
        assert report.explanation == "Not judged: neither a glottal area, nor a flow, nor a sound is given."
        assert (report.cycles, report.cycle_bounds, report.periodicity) == (0, None, None)


@pytest.mark.parametrize("vowel", ["a", "i", "u"])
def test_the_sound_of_a_run_alone_has_its_pitch_and_spectrum(vowel):
    run = vfcore.simulate(vfcore.Simulation(vowel=vowel, run=vfcore.Run(duration_s=0.6)))
    expected = run.report.measures
    signals = Signals.of_sound(run.arrays["far_pressure_pa"], run.provenance.sample_rate_hz)
    report = vfcore.measure(signals)
    assert report.state == "periodic" and report.judged == "far_pressure_pa"
    assert report.measures["fo_hz"].value == pytest.approx(expected["fo_hz"].value, rel=1e-3)
    assert report.measures["cpp_db"].value == expected["cpp_db"].value
    assert report.measures["h1_h2_sound_db"].value == pytest.approx(expected["h1_h2_sound_db"].value, abs=0.01)
    assert report.measures["closed_quotient"].value is None
    start, stop = report.cycle_bounds
    assert stop - start == pytest.approx(signals.sample_rate_hz / expected["fo_hz"].value, abs=1)


@pytest.mark.parametrize("rate_hz", [8_000.0, 44_100.0])
@pytest.mark.parametrize("fo_hz", [82.0, 123.4, 261.6])
def test_a_sawtooth_is_measured_as_a_sound(fo_hz, rate_hz):
    harmonics = np.arange(1, int(rate_hz / 2 / fo_hz))[:, None]
    sawtooth = (np.sin(2 * np.pi * fo_hz * harmonics * times(1.0, rate_hz)) / harmonics).sum(axis=0)
    report = vfcore.measure(Signals.of_sound(0.1 * sawtooth, rate_hz))
    assert report.state == "periodic"
    assert report.measures["fo_hz"].value == pytest.approx(fo_hz, rel=1e-3)
    assert report.measures["h1_h2_sound_db"].value == pytest.approx(6.0206, abs=0.01)


@pytest.mark.parametrize(("vowel", "fo_hz"), [("a", 371.0), ("e", 233.7), ("i", 140.0)])
def test_a_resonance_on_the_second_harmonic_makes_no_subharmonic_of_a_sound(vowel, fo_hz):
    """The first resonance lies near twice this f_o: half a cycle later the sound is much like itself."""
    flow = 800 * MM2 * raised_pulse(steady_phase(T, fo_hz), 0.5, 1.5)
    report = measure_all(Signals.of_sound(radiate(flow, 1 / RATE_HZ, vowel_tract(vowel)).far_pressure_pa, RATE_HZ))
    assert report.state == "periodic"
    assert report.measures["fo_hz"].value == pytest.approx(fo_hz, rel=1e-4)


@pytest.mark.parametrize(("name", "state"), [
    ("glottal_flow_m3_s", "subharmonic"), ("far_pressure_pa", "periodic"),
])  # fmt: skip
def test_strong_alternation_has_the_f_o_of_its_pattern(name, state):
    """A sound tells it from one long cycle no more, but it repeats no sooner."""
    whole = signals_from(PULSES * alternating(steady_phase(T, FO_HZ), 0.4), RATE_HZ)
    report = measure_all(only(whole, {name}))
    assert report.state == state
    assert report.measures["fo_hz"].value == pytest.approx(FO_HZ / 2, rel=1e-4)


@pytest.mark.parametrize(("noise", "state"), [(0.02, "periodic"), (0.5, "irregular")])
def test_a_sound_may_be_noisier_than_an_area(noise, state):
    sound = WHOLE["periodic"].far_pressure_pa
    hiss = np.random.default_rng(4).standard_normal(len(sound)) * sound.std()
    report = measure_all(Signals.of_sound(sound + noise * hiss, RATE_HZ))
    assert report.state == state
    assert report.measures["fo_hz"].value == pytest.approx(FO_HZ, rel=5e-3)


@pytest.mark.parametrize(("signals", "words"), [
    (Signals.of_sound(np.zeros(28_000), RATE_HZ), "there is no sound"),
    (Signals.of_sound(1e-7 * np.sin(2 * np.pi * 150 * T), RATE_HZ), "less than the 0.00113 Pa that would be audible"),
    (Signals(RATE_HZ, glottal_flow_m3_s=np.zeros(28_000)), "no air flows"),
    (Signals(RATE_HZ, glottal_flow_m3_s=2e-4 + 1e-6 * np.sin(2 * np.pi * 150 * T)), "2 mL/s, less than the 4 mL/s"),
    (Signals(RATE_HZ, glottal_flow_m3_s=2e-4 + 3e-6 * np.sin(2 * np.pi * 150 * T)), "3 % of its mean"),
    (Signals.of_sound(np.exp(-T / 0.2) * np.sin(2 * np.pi * 150 * T), RATE_HZ), "the vibration dies out"),
    (Signals.of_sound(np.random.default_rng(0).standard_normal(28_000), RATE_HZ), ""),
])  # fmt: skip
def test_what_is_no_voice_is_none_in_a_flow_or_a_sound(signals, words):
    report = measure_all(signals)
    assert words in report.explanation
    assert report.state == "none" or not words
    assert report.measures["fo_hz"].value is None


def test_the_level_at_30_cm_follows_from_the_distance_of_the_microphone():
    sound = WHOLE["periodic"].far_pressure_pa
    near, far = (Signals.of_sound(sound, RATE_HZ, distance_m=distance) for distance in (0.3, 0.6))
    levels = [measure_all(one).measures["spl_30cm_db"].value for one in (near, far)]
    assert levels[0] == measure_all(WHOLE["periodic"]).measures["spl_30cm_db"].value
    assert levels[1] - levels[0] == pytest.approx(6.02, abs=0.001)


def test_a_contact_beside_a_sound_is_not_cut_in_two():
    """However late the sound arrives, contacts of unequal strength are counted once each."""
    strength = np.random.default_rng(2).uniform(0.2, 1.0, 200)[np.floor(steady_phase(T, FO_HZ) - 0.25).astype(int)]
    whole = WHOLE["periodic"]
    contacts = {name: getattr(whole, name) * strength for name in ("contact_pressure_max_pa", "contact_area_m2")}
    expected = measure_all(replace(whole, **contacts)).measures
    for delay in range(0, 180, 20):
        sound = np.roll(whole.far_pressure_pa, delay)
        measures = measure_all(Signals(RATE_HZ, far_pressure_pa=sound, **contacts)).measures
        for key in ("contact_quotient", "contact_pressure_max_pa", "contact_area_mm2"):
            assert measures[key].value == pytest.approx(expected[key].value, rel=0.02), (key, delay)


def test_a_sound_that_is_computed_on_demand_counts_as_given():
    whole, calls = WHOLE["periodic"], []
    silent = only(whole, {*WAVES, *NUMBERS} - {"lip_pressure_pa", "far_pressure_pa"})

    def radiated():
        calls.append(None)
        return Sound(whole.lip_pressure_pa, whole.far_pressure_pa)

    assert measure_all(silent, ["closed_quotient"], radiated).measures["closed_quotient"].value is not None
    assert not calls
    assert measure_all(silent, radiate=radiated) == measure_all(whole)
    assert len(calls) == 1


def test_measured_from_chooses_the_measured_part():
    sound = np.concatenate([np.zeros(14_000), WHOLE["periodic"].far_pressure_pa])
    late = measure_all(Signals.of_sound(sound, RATE_HZ, measured_from=14_000))
    assert late.state == "periodic"
    assert measure_all(Signals.of_sound(sound, RATE_HZ, measured_from=0)).state == "none"


@pytest.mark.parametrize("start", [-1, 22_400])
def test_a_measured_part_outside_the_signals_is_refused(start):
    with pytest.raises(ParameterError) as refused:
        Signals.of_sound(WHOLE["periodic"].far_pressure_pa, RATE_HZ, measured_from=start)
    assert refused.value.path == "signals.measured_from"


def test_what_is_not_given_cannot_be_read():
    analysis = Analysis(Signals.of_sound(WHOLE["periodic"].far_pressure_pa, RATE_HZ))
    assert SOUND in analysis.given
    for name in ("area", "flow", "lip_pressure", "contact_area", "open_phases"):
        with pytest.raises(LookupError):
            getattr(analysis, name)
    with pytest.raises(LookupError):
        _ = Analysis(signals_from(0 * T, RATE_HZ)).cycles
