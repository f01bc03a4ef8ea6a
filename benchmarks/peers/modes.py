"""Ten lowest modes about the loaded equilibrium: ours beside scipy's, and how far apart they are."""

import json
import math
import subprocess

from page import digits, table
from workspace import ENVIRONMENT, HERE, target_folder, xtask


def measure(python, stages, passes):
    """Ours and scipy's in turn, the fastest of all passes [s], and how far apart their ω² are."""
    xtask("mast", stages)
    command = [python, HERE / "scipy_modes.py", target_folder() / "bench", str(stages)]
    seconds, apart = {"ours": math.inf, "scipy": math.inf}, 0.0
    for _ in range(passes):
        ours = json.loads(xtask("modes", stages))
        theirs = json.loads(subprocess.check_output(command, env=ENVIRONMENT, text=True))
        seconds = {
            "ours": min(seconds["ours"], ours["modes"]),
            "scipy": min(seconds["scipy"], theirs["modes"]),
        }
        pairs = zip(ours["omega_squared"], theirs["omega_squared"], strict=True)
        apart = max(apart, *(abs(a / b - 1) for a, b in pairs))
    return seconds, apart


def modes_table(python, sizes, passes):
    """One column per size."""
    measured = [measure(python, n, passes) for n in sizes]
    rows = [
        [name, *(digits(1e3 * seconds[name]) for seconds, _ in measured)] for name in ("ours", "scipy")
    ]
    rows.append(["times as fast", *(digits(seconds["scipy"] / seconds["ours"]) for seconds, _ in measured)])
    rows.append(["largest relative difference of ω²", *(digits(apart) for _, apart in measured)])
    return table(["ten lowest modes, ms", *(f"N = {n}" for n in sizes)], rows)
