"""Joint torques over time: what a description predicts for a log, hypothesis by hypothesis, and what laws add to it."""
