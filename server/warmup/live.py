"""A voice that nobody hears: everything a played voice calls is compiled, or loaded, before the first one sounds."""

from vfcore.runs.gesture.voice import BLOCK_STEPS, Voice
from vfcore.spec.simulation import Activation, Simulation
from vocalis.server.live.shown import STATE_EVERY, Shown
from vocalis.server.live.strobe import Strobe

MOVED = Simulation(activation=Activation(ct=0.5))


def rehearse() -> None:
    """At rest, moving, changing its vowel, and shown."""
    voice, shown, strobe = Voice(Simulation(), played=True), Shown(), Strobe()
    targets = [Simulation(), MOVED, Simulation(vowel="i")]
    for k in range(STATE_EVERY):
        shown.take(voice.advance(targets[min(k, len(targets) - 1)], look_at=BLOCK_STEPS))
    strobe.moment(shown.area_m2, 1.0)
    shown.text({}, *voice.outline)
