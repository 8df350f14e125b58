"""Run the benchmark of truth: ``python benchmarks/hidden_effects`` or ``./run benchmark hidden-effects``."""

from __future__ import annotations

import sys
from pathlib import Path

if __name__ == "__main__":
    sys.path[0] = str(Path(__file__).parents[1])

    from hidden_effects.command import main

    main(sys.argv[1:])
