"""From cases to evidence, verdicts and the scoreboard."""
