"""Level, efficiency, harmonics, cepstral peak and perturbation of synthetic sounds."""

import numpy as np
import pytest

from tests.support.synthetic_waves import MM2, raised_pulse, signals_from, steady_phase, times, triangle
from vfcore.measures import measure_all
from vfcore.measures.spectrum import cepstral_peak_prominence_db

T = times()


def voiced(fo_hz=120.0, **changes):
    area = 20 * MM2 * raised_pulse(steady_phase(T, fo_hz), 0.5, 1.5)
    return measure_all(signals_from(area, **changes)).measures


def tone(fo_hz, amplitude=1.0, phase=0.0):
    return amplitude * np.cos(2 * np.pi * fo_hz * T + phase)


def test_level_of_a_tone_of_one_pascal_rms_is_94_db():
    measures = voiced(lip_pressure_pa=10 * np.sqrt(2) * tone(120), far_pressure_pa=np.sqrt(2) * tone(120))
    assert measures["spl_30cm_db"].value == pytest.approx(93.9794, abs=1e-3)
    assert measures["spl_lips_db"].value == pytest.approx(113.9794, abs=1e-3)


def test_a_steady_pressure_is_no_sound():
    steady = voiced(lip_pressure_pa=5.0 + np.sqrt(2) * tone(120), far_pressure_pa=3.0 + 0 * T)
    assert steady["spl_lips_db"].value == pytest.approx(93.9794, abs=1e-3)
    for key in ("spl_30cm_db", "efficiency_db", "cpp_db", "h1_h2_sound_db"):
        assert steady[key].value is None
        assert steady[key].reason


def test_efficiency_is_radiated_over_aerodynamic_power():
    flow = 200e-6 * raised_pulse(steady_phase(T, 120.0), 0.5, 1.5)
    measures = voiced(
        far_pressure_pa=0.2 * np.sqrt(2) * tone(120), glottal_flow_m3_s=flow, subglottal_pressure_pa=800.0
    )
    # The mean of sin² over half of the cycle is a quarter; 4πr² p²/(ρc) with ρ = 1.14, c = 350, r = 0.3.
    expected = 4 * np.pi * 0.09 * 0.04 / (1.14 * 350) / (800.0 * 50e-6)
    assert measures["efficiency"].value == pytest.approx(expected, rel=1e-3)
    assert measures["efficiency_db"].value == pytest.approx(10 * np.log10(expected), abs=0.01)


def test_efficiency_without_aerodynamic_power_is_missing():
    measures = voiced(subglottal_pressure_pa=0.0)
    assert measures["efficiency"].value is None
    assert measures["efficiency_db"].value is None
    assert "aerodynamic power" in measures["efficiency_db"].reason


@pytest.mark.parametrize("fo_hz", [60.0, 97.3, 149.6, 333.3, 499.7])
@pytest.mark.parametrize("ratio_db", [-6.0, 0.0, 12.0, 30.0])
def test_h1_h2_is_the_ratio_of_the_first_two_harmonics(fo_hz, ratio_db):
    second = 10 ** (-ratio_db / 20)
    wave = tone(fo_hz) + second * tone(2 * fo_hz, phase=1.0) + 0.5 * tone(3 * fo_hz, phase=2.0) + 4.0
    measures = voiced(fo_hz, glottal_flow_m3_s=1e-4 * wave, far_pressure_pa=wave)
    assert measures["h1_h2_flow_db"].value == pytest.approx(ratio_db, abs=0.02)
    assert measures["h1_h2_sound_db"].value == pytest.approx(ratio_db, abs=0.02)


def harmonics(fo_hz):
    """Equal cosine harmonics to 10 kHz: a pulse train."""
    return sum(tone(k * fo_hz) for k in range(1, int(10_000 / fo_hz) + 1))


def naive_cepstral_peak_prominence(wave, length=1792, filled=1792, band=512):
    """Hillenbrand et al. (1994) frame by frame: 51.2 ms, Hamming, to 10 kHz, line from 1 ms on, peak 60 to 500 Hz."""
    prominences = []
    for begin in range(0, len(wave) - length + 1, length // 2):
        frame = wave[begin : begin + length]
        lines = np.fft.fft((frame - frame.mean()) * np.hamming(length), filled)[: band + 1]
        line_level = 10 * np.log10(np.abs(lines) ** 2)
        symmetric = np.concatenate([line_level, line_level[-2:0:-1]])  # 0 to 20 kHz
        cepstrum = 20 * np.log10(np.abs(np.fft.ifft(symmetric)))[: band + 1]
        quefrency = np.arange(band + 1) * 50e-6
        line = np.polyval(np.polyfit(quefrency[20:], cepstrum[20:], 1), quefrency)
        voice = (quefrency >= 1 / 500) & (quefrency <= 1 / 60)
        peak = np.flatnonzero(voice)[np.argmax(cepstrum[voice])]
        prominences.append(cepstrum[peak] - line[peak])
    return np.mean(prominences)


@pytest.mark.parametrize("fo_hz", [80.0, 149.6, 333.3])
@pytest.mark.parametrize("share_of_noise", [0.0, 0.3])
def test_cepstral_peak_prominence_follows_its_definition(fo_hz, share_of_noise):
    noise = np.random.default_rng(5).standard_normal(len(T))
    sound = harmonics(fo_hz) + share_of_noise * noise * np.std(harmonics(fo_hz))
    expected = naive_cepstral_peak_prominence(sound[len(T) // 2 :])
    assert voiced(fo_hz, far_pressure_pa=sound)["cpp_db"].value == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize("fo_hz", [80.0, 149.6, 333.3])
def test_cepstral_peak_prominence_at_the_rate_of_a_run_is_that_of_its_definition(fo_hz):
    """28 kHz, where a frame has 1434 samples and is filled up."""
    time, noise = times(0.5, 28_000.0), np.random.default_rng(6).standard_normal(14_000)
    pulses = sum(np.cos(2 * np.pi * k * fo_hz * time) for k in range(1, int(10_000 / fo_hz) + 1))
    sound = pulses + 0.3 * noise * np.std(pulses)
    expected = naive_cepstral_peak_prominence(sound, 1434, filled=1470, band=525)
    assert cepstral_peak_prominence_db(sound, 28_000.0) == pytest.approx(expected, abs=1e-6)


def test_cepstral_peak_at_a_rate_that_suits_no_transform():
    """At 24.611 kHz no line falls on 10 kHz; the definition's own lengths are taken."""
    rate = 24_611.0
    time = times(0.5, rate)
    sound = sum(np.cos(2 * np.pi * k * 150 * time) for k in range(1, 66))
    sound = sound + 0.3 * np.std(sound) * np.random.default_rng(7).standard_normal(len(time))
    expected = naive_cepstral_peak_prominence(sound, 1260, filled=1260, band=511)
    assert cepstral_peak_prominence_db(sound, rate) == pytest.approx(expected, abs=0.5)


@pytest.mark.parametrize("fo_hz", [80.0, 120.0, 200.0, 280.0])
def test_cepstral_peak_of_a_pulse_train_sinks_into_noise(fo_hz):
    noise = np.random.default_rng(5).standard_normal(len(T)) * np.std(harmonics(fo_hz))
    prominence = [
        voiced(fo_hz, far_pressure_pa=harmonics(fo_hz) + share * noise)["cpp_db"].value for share in (0.0, 0.1, 0.5, 10)
    ]
    assert prominence[0] > prominence[1] > prominence[2] > prominence[3] + 3
    assert prominence[0] > 30  # Skowronski et al. (2015): 35 ± 4 dB on pulse trains by Hillenbrand's own program


def test_cepstral_peak_does_not_depend_on_loudness():
    quiet = voiced(far_pressure_pa=1e-3 * harmonics(120.0))["cpp_db"].value
    assert voiced(far_pressure_pa=50 * harmonics(120.0))["cpp_db"].value == pytest.approx(quiet, abs=1e-6)


@pytest.mark.parametrize("key", ["jitter_percent", "shimmer_percent", "hnr_db"])
def test_perturbation_of_a_repeating_model_is_not_applicable(key):
    periodic = voiced()[key]
    assert periodic.value is None
    assert periodic.reason.startswith("Not applicable")
    assert "healthy" in periodic.reason


@pytest.mark.parametrize("fo_hz", [97.3, 149.6, 233.7])
@pytest.mark.parametrize("spread", [0.01, 0.03])
def test_jitter_is_the_mean_step_between_cycle_lengths(fo_hz, spread):
    rng = np.random.default_rng(11)
    starts = np.cumsum((1 + spread * rng.standard_normal(600)) / fo_hz)
    report = measure_all(signals_from(10 * MM2 * triangle(np.interp(T, starts, np.arange(600)), 0.5, 1.5)))
    assert report.state == "irregular"
    periods = np.diff(starts[(starts > 0.5) & (starts < 1.0)])
    expected = 100 * np.abs(np.diff(periods)).mean() / periods.mean()
    assert report.measures["jitter_percent"].value == pytest.approx(expected, rel=0.1)


def test_shimmer_is_the_mean_step_between_cycle_amplitudes():
    fo_hz = 149.6
    phase = steady_phase(T, fo_hz)
    heights = 1 + 0.2 * np.random.default_rng(2).standard_normal(400)
    height = heights[np.floor(phase).astype(int)]
    sound = height * np.sin(4 * np.pi * np.minimum(np.mod(phase, 1.0), 0.5))  # one wave while the glottis is open
    report = measure_all(signals_from(10 * MM2 * triangle(phase, 0.5, 1.5) * height, lip_pressure_pa=sound))
    assert report.state == "irregular"
    inside = heights[int(0.5 * fo_hz) + 1 : int(fo_hz)]
    expected = 100 * np.abs(np.diff(inside)).mean() / inside.mean()
    assert report.measures["shimmer_percent"].value == pytest.approx(expected, rel=0.1)


@pytest.mark.parametrize("hnr_db", [3.0, 10.0, 20.0])
def test_hnr_of_a_sound_in_white_noise(hnr_db):
    fo_hz = 150.0
    golden = (3 - np.sqrt(5)) / 2
    area = 10 * MM2 * triangle(steady_phase(T, fo_hz), 0.5, 1.5) * (1 + 0.3 * np.sin(2 * np.pi * golden * fo_hz * T))
    noise = np.random.default_rng(4).standard_normal(len(T)) * 10 ** (-hnr_db / 20)
    sound = np.sqrt(2) * tone(fo_hz) + noise
    report = measure_all(signals_from(area, lip_pressure_pa=sound))
    assert report.state == "irregular"
    assert report.measures["hnr_db"].value == pytest.approx(hnr_db, abs=0.5)


def test_hnr_of_a_sound_without_noise_is_missing_and_not_huge():
    fo_hz, golden = 150.0, (3 - np.sqrt(5)) / 2
    area = 10 * MM2 * triangle(steady_phase(T, fo_hz), 0.5, 1.5) * (1 + 0.3 * np.sin(2 * np.pi * golden * fo_hz * T))
    hnr = measure_all(signals_from(area, lip_pressure_pa=tone(fo_hz))).measures["hnr_db"]
    assert hnr.value is None
    assert "no noise" in hnr.reason
