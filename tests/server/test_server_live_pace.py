"""When a voice wakes: for control messages and for due blocks, and never late for either."""

import random

import pytest

from vocalis.server.live.pace import AT_REST, EARLY_S, PAUSE_S, Pace

BLOCK_S = 0.01


def played(messages_s: list[float], seconds: float) -> tuple[int, list[float], list[float]]:
    """Wakes in the last half; how late each block was made there, s; how long each message waited for its block, s."""
    pace, now, wakes, late, waited, calm = Pace(BLOCK_S), 0.0, 0, [], [], 0
    newest = 0.0
    messages = list(messages_s)
    while now < seconds:
        now = max(now, min(pace.wakes_s, messages[0] if messages else seconds))
        arrived = [message for message in messages if message <= now]
        messages = messages[len(arrived) :]
        pace.moved |= bool(arrived)
        calm, newest = (0, arrived[-1]) if arrived else (calm, newest)
        counted = now > seconds / 2
        wakes += counted
        if pace.wakes_s > now + EARLY_S:
            continue
        if counted and pace.moved:
            waited.append(max(now, pace.due_s) - newest)
        until = pace.turn(now, calm > 25)
        while pace.due_s <= until:
            late.append(now - pace.due_s if counted else 0.0)
            pace.block()
            calm += 1
    return wakes, late, waited


def test_it_wakes_once_a_message_which_waits_no_longer_than_for_the_due_block():
    jitter = random.Random(5)
    messages = [k / 60 + jitter.uniform(0, 5e-4) for k in range(600)]
    wakes, late, waited = played(messages, 10.0)
    assert wakes < 5 * 65, "sixty a second, not a hundred"
    assert max(late) < 1e-9
    assert max(waited) < BLOCK_S + 0.003 and sum(waited) / len(waited) < 0.0075


@pytest.mark.parametrize("rate", [20, 40, 125, 500])
def test_other_message_rates_have_the_same_latency(rate):
    wakes, late, waited = played([k / rate for k in range(10 * rate)], 10.0)
    assert max(late) < 1e-9
    assert max(waited) < BLOCK_S + PAUSE_S
    assert wakes < 5 * (100 + rate)


def test_at_rest_it_makes_two_blocks_a_turn():
    wakes, late, _ = played([], 10.0)
    assert wakes == pytest.approx(500 / AT_REST, abs=3)
    assert max(late) < 1e-9


def test_the_client_is_given_what_it_lacks_and_a_long_sleep_is_not_made_up_for():
    pace = Pace(BLOCK_S)
    pace.lead_error_s = 0.02
    for _ in range(300):
        pace.block()
    assert pace.due_s == pytest.approx(3.0 - 0.02, abs=1e-4)
    pace.keep_up(3.1)
    assert pace.due_s < 3.0
    pace.keep_up(4.0)
    assert pace.due_s == 4.0
