"""python -m tests.hardening.hostile [COUNT [TRAINEES]]"""

import json
import sys
import tempfile
from pathlib import Path

from tests.hardening.hostile.running import run

if __name__ == "__main__":
    count, trainees = [*map(int, sys.argv[1:]), *(10_000, 10)[len(sys.argv) - 1 :]]
    with tempfile.TemporaryDirectory() as place:
        print(json.dumps(run(count, trainees, Path(place)), indent=1))
