"""When a played voice makes its blocks: when they are due, and a few before that for a word of the hand.

A word of the hand is followed by the blocks that are due before its next one. They sound when they would have, and have
heard as much: what the hand says next comes after the moment when they were due. So a hand that says sixty words a
second wakes the voice sixty times and not a hundred.
"""

EARLY_S = 0.002  # a voice that is due so soon is played along with the one before
AT_REST = 2  # blocks a turn: a processor that was just woken takes three times as long over the first
WORDS_S = (0.008, 0.022)  # what may be expected between two words
FIRST_GUESS_S = 1 / 60
FOLLOWS = 0.1  # share of the newest interval in what is expected of the next one
LATE_S = 0.001  # by which a word may be late
PAUSE_S = 0.012  # a hand that says more words is heard when so much has passed since the last turn it brought
PACE_GAIN = 0.035  # share of the buffer's error that a block makes good
LARGEST_LAG_S = 0.2  # behind by more than this (a sleeping machine): begin again from now


class Pace:
    """``due_s``: when the next block is due. ``lead_error_s``: how much less than it wants the client has waiting."""

    def __init__(self, block_s: float):
        self._block_s = block_s
        self.due_s = self.lead_error_s = 0.0
        self.moved = False  # the hand has, since the last turn
        self._hears_from_s = self._heard_s = 0.0
        self._words_s = FIRST_GUESS_S

    @property
    def wakes_s(self) -> float:
        """When there is something to do if nobody says anything more."""
        return min(self.due_s, self._hears_from_s) if self.moved else self.due_s

    def turn(self, now_s: float, resting: bool) -> float:
        """Begin a turn: make the blocks that are due until the time returned."""
        if self.moved:
            interval = min(max(now_s - self._heard_s, WORDS_S[0]), WORDS_S[1])
            self._words_s += FOLLOWS * (interval - self._words_s)
            self.moved, self._heard_s, self._hears_from_s = False, now_s, now_s + PAUSE_S
            return now_s + self._words_s + LATE_S
        return now_s + EARLY_S + ((AT_REST - 1) * self._block_s if resting else 0.0)

    def block(self) -> None:
        """A block was made."""
        self.due_s += self._block_s - PACE_GAIN * self.lead_error_s
        self.lead_error_s *= 1.0 - PACE_GAIN

    def keep_up(self, now_s: float) -> None:
        """Let go of what can no longer be made in time."""
        if self.due_s < now_s - LARGEST_LAG_S:
            self.due_s = now_s
