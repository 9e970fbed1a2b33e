"""Speed and accuracy beside a named peer. `python -m benchmarks` runs all, `python -m benchmarks NAME...` some.

A file is found by its `run()`, which gives rows with `name`, `ours`, `peer`, `peer_name` and, where they differ
from seconds without an aim, `unit` and `aim` (rows.py).
"""
