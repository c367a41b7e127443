"""One live voice, in the voice process: control messages in, a block of sound every 10 ms out."""

import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from typing import Any

from vfcore.errors import ParameterError, VocalisError
from vfcore.fold.form import StepForm
from vfcore.io.audio import AUDIO_RATE_HZ, FULL_SCALE_PA
from vfcore.io.result_document import json_text
from vfcore.runs.gesture.forms import form_of, is_loaded
from vfcore.runs.gesture.slew import come_or_gone, differences, is_near, slew_limited
from vfcore.runs.gesture.voice import BLOCK_S, Voice, fixed_part_changed
from vfcore.spec.paths import value_at
from vfcore.spec.request import flat, patched
from vfcore.spec.simulation import Simulation
from vfcore.version import MODEL_VERSION
from vocalis.server.live import forms
from vocalis.server.live.client import GOING_AWAY, Client, ClientGone
from vocalis.server.live.forms import Loading
from vocalis.server.live.pace import EARLY_S, Pace
from vocalis.server.live.protocol import BLOCK_SAMPLES, CONTROLS, SoundFrame, read_message
from vocalis.server.live.recording import Recording
from vocalis.server.live.state_frame import STATE_EVERY, StateFrame, rounded
from vocalis.server.live.strobe import Strobe
from vocalis.server.problems import problem_of

FIRST_MESSAGE_S = 0.25  # a client that sends nothing until then gets the modal voice
LEAD_BLOCKS = 3  # sent at once, so that the client has a buffer to play from
CALM_BLOCKS = 25  # after this long without a change the voice is at rest
MOST_AT_ONCE = 4  # blocks a turn when a voice is late, because the others wait


class Player:
    """Plays until its client leaves: ``prepare`` once, then ``turn`` whenever it is ``due_s``.

    ``_wanted`` is the request in force, ``_goal`` the one that the voice moves towards: the same, except while the form
    of the step that ``_wanted`` needs is loaded.
    """

    def __init__(self, client: Client):
        self._client = client
        self._stopping = self._over = False
        self._wanted: Simulation = Simulation()
        self._goal: Simulation = self._wanted
        self._loading: Loading | None = None
        self._record_when_loaded = False
        self._paths: tuple[str, ...] = ()
        self._made: Voice | None = None
        self._strobe = Strobe()
        self._recording: Recording | None = None
        self._first_recorded = 0
        self._sequence = 0
        self._calm = 0
        self._frame = StateFrame()
        self._sound = SoundFrame()
        self._pace = Pace(BLOCK_S)

    def is_due(self, now_s: float) -> bool:
        """Whether it is time for a turn: for the next block, or for a control message."""
        return self.wakes_s <= now_s + EARLY_S

    @property
    def wakes_s(self) -> float:
        """The time of the next turn if no further message comes."""
        return self._pace.wakes_s

    @property
    def is_open(self) -> bool:
        """Whether its client may still send messages."""
        return not self._over

    def fileno(self) -> int:
        return self._client.fileno()

    def prepare(self) -> bool:
        """Wait for the first message and make that voice, which may compile; False when it is over."""
        return self._continues(self._begin_playing)

    def receive(self) -> bool:
        """Take the messages of the client; False when the voice is over."""
        return self._continues(self._receive)

    def turn(self) -> bool:
        """Make the blocks that are due; False when the voice is over. A voice that fails sends the problem."""
        return self._continues(self._make_blocks)

    def stop(self) -> None:
        """End the voice because the server stops; may be called from any thread."""
        self._stopping = True

    def close(self) -> None:
        self._client.close()

    def _continues(self, act: Callable[[], None]) -> bool:
        if not self._over:
            try:
                act()
                if not self._pace.moved:  # otherwise the blocks that follow at once are sent with it
                    self._client.flush()
            except ClientGone:
                self._over = True
            except VocalisError as error:
                self._send({"type": "problem", "problem": problem_of(error), "over": True})
                self._end()
        if not self._over:
            return True
        self._pace.moved, self._pace.due_s = False, time.monotonic() + BLOCK_S
        return self._client.is_closing()

    def _end(self, *why: Any) -> None:
        self._client.begin_close(*why)
        self._over = True

    def _begin_playing(self) -> None:
        self._client.wait(FIRST_MESSAGE_S)
        self._receive()
        forms.load(form_of(self._goal))
        self._begin()
        self._send({"type": "ready", "rate_hz": AUDIO_RATE_HZ, "block": BLOCK_SAMPLES,
                   "full_scale_pa": FULL_SCALE_PA, "model_version": MODEL_VERSION})  # fmt: skip
        self._pace.due_s = time.monotonic() - LEAD_BLOCKS * BLOCK_S

    def _make_blocks(self) -> None:
        if self._stopping:
            return self._end(GOING_AWAY, "the server stops")
        now = time.monotonic()
        until_s = self._pace.turn(now, self._calm > CALM_BLOCKS)
        for _ in range(MOST_AT_ONCE):
            if self._pace.due_s > until_s:
                break
            self._block()
            self._pace.block()
        self._pace.keep_up(now)

    @property
    def _voice(self) -> Voice:
        assert self._made is not None, "prepare() comes first"
        return self._made

    def _begin(self) -> None:
        self._made = Voice(self._goal, played=True)
        self._paths = ()
        self._strobe = Strobe()
        self._frame.clear()

    def _block(self) -> None:
        if self._loading is not None and not self._loading.thread.is_alive():
            self._loaded(self._loading)
        voice = self._voice
        target = self._target(voice.request)
        self._calm += 1
        show = (self._sequence + 1) % STATE_EVERY == 0
        look_at = 0
        if show:
            look_at = self._strobe.moment(self._frame.area_m2, STATE_EVERY * BLOCK_S)
        block = voice.advance(target, look_at)
        if self._recording is not None:
            self._recording.take(voice.blocks, target)
        self._client.send_sound(self._sound.of(self._sequence, block.audio_pa))
        self._sequence += 1
        self._frame.take(block)
        if show:
            self._send_state()
            self._frame.clear()

    def _target(self, now: Simulation) -> Simulation:
        """The request that the next block ends at."""
        wanted = self._goal
        if not self._paths:
            target = now
        elif all(is_near(now, wanted, path) for path in self._paths):
            self._paths = ()
            return wanted
        else:
            target = slew_limited(now, wanted, self._paths)
            self._paths = tuple(p for p in self._paths if value_at(target, p) != value_at(wanted, p))
        return target if target.vowel == wanted.vowel else replace(target, vowel=wanted.vowel)

    def _send_state(self) -> None:
        """Send what the page draws: the folds at the moment of the strobe, and the waves since the last frame."""
        voice = self._voice
        state = {
            "type": "state",
            "sequence": self._sequence,
            "time_s": round(voice.blocks * BLOCK_S, 3),
            "fo_hz": rounded(self._strobe.fo_hz),
            "strain": voice.posture.strain,
            "glottal_half_angle_rad": voice.posture.glottal_half_angle_rad,
            "length_m": voice.posture.length_m,
            "recording_s": None if self._recording is None else round(self._recording.blocks * BLOCK_S, 2),
        }
        self._client.send(self._frame.text(state, *voice.outline))

    def _receive(self) -> None:
        """Take all messages since the last call, in their order; one that cannot be used is reported and dropped."""
        record: bool | None = None
        stamp: int | None = None
        for text in self._client.messages():
            try:
                message = read_message(text)
                if "wanted_buffer_ms" in message and "buffer_ms" in message:
                    self._pace.lead_error_s = (message["wanted_buffer_ms"] - message["buffer_ms"]) / 1e3
                record, stamp = message.get("record", record), message.get("stamp", stamp)
                patch = flat({key: value for key, value in message.items() if key not in CONTROLS})
                if patch:
                    self._want(patch)
            except ParameterError as error:
                self._send({"type": "problem", "problem": problem_of(error), "over": False})
        if record is not None:
            self._record(record)
        if stamp is not None:
            self._send({"type": "heard", "stamp": stamp, "sequence": self._sequence})

    def _want(self, patch: dict[str, Any]) -> None:
        """Play towards the request in force with a patch; ParameterError where a voice cannot do that."""
        voice = self._made
        wanted = patched(self._wanted, patch)
        if voice is not None:
            if (part := fixed_part_changed(voice.request, wanted)) is not None:
                raise ParameterError(part, "cannot change while the voice is played", "a new connection")
            if (part := come_or_gone(self._wanted, wanted)) is not None:
                raise ParameterError(part, "cannot come or go while the voice is played", "a new connection")
            self._pace.moved = True
        self._wanted = wanted
        if voice is None:
            self._goal = wanted
        elif not self._head_for_wanted():
            with suppress(ParameterError):  # what it moves may be absent until the form is loaded
                goal = patched(self._goal, patch)
                if voice.form_for(goal) == voice.form:
                    self._head_for(goal)

    def _head_for_wanted(self) -> bool:
        """Let the voice move towards the request in force; False where it needs a form that is yet to be loaded."""
        form = self._voice.form_for(self._wanted)
        if form == self._voice.form or self._has_loaded(form):
            self._head_for(self._wanted)
            return True
        return False

    def _loaded(self, loading: Loading) -> None:
        """Do what had to wait for a form."""
        self._head_for_wanted()
        if self._record_when_loaded:
            self._record(True)
        if self._loading is loading:
            self._loading = None

    def _has_loaded(self, form: StepForm) -> bool:
        """Whether a form can be marched at once; if not, a thread loads it."""
        if self._loading is not None and not self._loading.thread.is_alive():
            if self._loading.form == form:
                return True  # or could not be loaded: then it is compiled here
            self._loading = None
        if is_loaded(form):
            return True
        if self._loading is None:
            self._loading = forms.load_in_thread(form)
        return False

    def _head_for(self, wanted: Simulation) -> None:
        """Let the voice move towards a request."""
        self._goal = wanted
        self._paths = differences(self._voice.request, wanted)
        self._calm = 0

    def _record(self, on: bool) -> None:
        self._record_when_loaded = False
        if on:
            if not self._has_loaded(form_of(self._goal)):
                self._record_when_loaded = True
                return
            self._begin()
            self._recording = Recording(self._goal)
            self._first_recorded = self._sequence
        elif self._recording is not None:
            document = self._recording.document()
            self._send({"type": "gesture", "first_sequence": self._first_recorded, "gesture": document})
            self._recording = None

    def _send(self, document: dict[str, Any]) -> None:
        self._client.send(json_text(document))
