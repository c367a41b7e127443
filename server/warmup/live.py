"""Warm-up of live voices: compiles or loads everything that a voice calls."""

from vfcore.runs.gesture.voice import BLOCK_STEPS, Voice
from vfcore.spec.simulation import Activation, Simulation
from vocalis.server.live.state_frame import STATE_EVERY, StateFrame
from vocalis.server.live.strobe import Strobe

MOVED = Simulation(activation=Activation(ct=0.5))


def warm_up_voice() -> None:
    """Play a voice without a client: at rest, moving, changing its vowel, with its pictures."""
    voice, frame, strobe = Voice(Simulation(), played=True), StateFrame(), Strobe()
    targets = [Simulation(), MOVED, Simulation(vowel="i")]
    for k in range(STATE_EVERY):
        frame.take(voice.advance(targets[min(k, len(targets) - 1)], look_at=BLOCK_STEPS))
    strobe.moment(frame.area_m2, 1.0)
    frame.text({}, *voice.outline)
