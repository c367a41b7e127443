"""When a live voice makes its blocks: when they are due, or a little earlier after a control message.

A control message is followed at once by all blocks that are due before the next expected message. They sound when they
would have sounded, and miss no message: the next one comes after the moment when they were due. So a client that sends
sixty messages a second wakes the voice sixty times instead of a hundred.
"""

EARLY_S = 0.002  # a voice that is due within this time is played in the same turn
AT_REST = 2  # blocks a turn: a core that was just woken takes three times as long over the first
INTERVALS_S = (0.008, 0.022)  # limits of the expected interval between two messages
FIRST_INTERVAL_S = 1 / 60
SMOOTHING = 0.1  # weight of the newest interval in the expected one
LATE_S = 0.001  # by which a message may be late
PAUSE_S = 0.012  # from one message that is answered at once to the next one
PACE_GAIN = 0.035  # share of the buffer's error that one block corrects
LARGEST_LAG_S = 0.2  # after a longer gap (a sleeping machine) the voice continues from now


class Pace:
    """``due_s``: when the next block is due. ``lead_error_s``: the sound that the client lacks in its buffer.

    Set ``moved`` when a control message has changed the voice; ``turn`` resets it.
    """

    def __init__(self, block_s: float):
        self._block_s = block_s
        self.due_s = self.lead_error_s = 0.0
        self.moved = False
        self._answers_from_s = self._answered_s = 0.0
        self._interval_s = FIRST_INTERVAL_S

    @property
    def wakes_s(self) -> float:
        """The time of the next turn if no further message comes."""
        return min(self.due_s, self._answers_from_s) if self.moved else self.due_s

    def turn(self, now_s: float, resting: bool) -> float:
        """Begin a turn: make the blocks that are due until the time returned."""
        if self.moved:
            interval = min(max(now_s - self._answered_s, INTERVALS_S[0]), INTERVALS_S[1])
            self._interval_s += SMOOTHING * (interval - self._interval_s)
            self.moved, self._answered_s, self._answers_from_s = False, now_s, now_s + PAUSE_S
            return now_s + self._interval_s + LATE_S
        return now_s + EARLY_S + ((AT_REST - 1) * self._block_s if resting else 0.0)

    def block(self) -> None:
        """A block was made."""
        self.due_s += self._block_s - PACE_GAIN * self.lead_error_s
        self.lead_error_s *= 1.0 - PACE_GAIN

    def keep_up(self, now_s: float) -> None:
        """Skip the blocks that can no longer be made in time."""
        if self.due_s < now_s - LARGEST_LAG_S:
            self.due_s = now_s
