"""Everything a live voice calls is compiled before it sounds: a block that waits for a compiler is a gap of seconds."""

import subprocess
import sys

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


def test_nothing_is_left_to_compile_when_the_first_voice_sounds():
    answer = subprocess.run([sys.executable, "-c", PLAY], capture_output=True, text=True, timeout=300)
    assert answer.stdout.split() == ["True", "0"], answer.stdout + answer.stderr
