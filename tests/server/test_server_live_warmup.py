"""Everything a live voice calls is compiled before it sounds: a block that waits for a compiler is a gap of seconds."""

import subprocess
import sys

import pytest

PLAY = """
import gc
from numba.core.registry import CPUDispatcher
from vocalis.server.warmup.live import warm_up_voice
from vfcore.runs.gesture.voice import Voice
from vfcore.spec.simulation import Activation, Simulation
from vocalis.server.live.state_frame import StateFrame
from vocalis.server.live.strobe import Strobe

def compiled():
    return sum(len(found.overloads) for found in gc.get_objects() if isinstance(found, CPUDispatcher))

warm_up_voice()
before = compiled()
voice, frame, strobe = Voice(Simulation(subglottal_pressure_pa=1200), played=True), StateFrame(), Strobe()
for k in range(7):
    target = Simulation(activation=Activation(ct=1, ta=k / 10), convergence_angle_rad=0, vowel="ai"[k > 3])
    frame.take(voice.advance(target, look_at=10 * k))
strobe.moment(frame.area_m2, 1.0)
frame.text({}, *voice.outline)
print(before > 5, compiled() - before)
"""


FOLDS_DIFFER = """
from vfcore.runs.gesture import forms
from vfcore.spec.request import patched, resolve

warm_up_voice()
voice, frame = Voice(Simulation(), played=True), StateFrame()
voice.advance(Simulation())
sides = [patched(Simulation(), {"right.activation.ta": ta}) for ta in (0.2, 0.1)]
forms.load(voice.form_for(sides[0]))
before = compiled()
for target in sides:
    frame.take(voice.advance(target, look_at=280))
frame.text({}, *voice.outline)
voice = Voice(sides[0], played=True)
voice.advance(sides[0])
print(voice.form.walls == 2, compiled() - before)
"""


@pytest.mark.parametrize(
    "play", [PLAY, PLAY[: PLAY.index("warm_up_voice()\nbefore")] + FOLDS_DIFFER], ids=["one fold", "two folds"]
)
def test_nothing_is_left_to_compile_when_the_first_voice_sounds(play):
    answer = subprocess.run([sys.executable, "-c", play], capture_output=True, text=True, timeout=300)
    assert answer.stdout.split() == ["True", "0"], answer.stdout + answer.stderr
