"""Error against processor time: the curves of all tools on one mast, and their table."""

import json
import math
import subprocess
import sys

from page import digits, table
from workspace import ENVIRONMENT, HERE, target_folder, xtask

TOOLS = ["mujoco_mast.py", "drake_mast.py", "exudyn_mast.py"]
FULL = 32  # largest mast on which other tools make whole runs; beyond, errors are those of this one
TARGETS = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8]


def tool_points(python, script, stages, limit):
    """Points of one tool, without errors for large masts; a tool that is missing is said and left out."""
    command = [python, HERE / script, ".", str(stages), "--limit", str(limit)]
    command += ["--costs"] if stages > FULL else []
    # Some tools leave a log where they run.
    done = subprocess.run(command, cwd=target_folder() / "bench", env=ENVIRONMENT, capture_output=True, text=True)
    if done.returncode != 0:
        print(f"{script}, N = {stages}: {done.stderr.strip()[-500:]}", file=sys.stderr)
    return [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]


def measure(python, stages, limit, passes, floor):
    """The fastest of all passes, point by point; passes of all tools alternate."""
    xtask("mast", stages)
    best = {}
    for _ in range(passes):
        points = json.loads(xtask("curves", stages, "--limit", limit, *(["--floor", floor] if floor else [])))
        for script in TOOLS:
            points += tool_points(python, script, stages, limit)
        for point in points:
            key = point["tool"], point["variant"], point["dial"]
            known = best.setdefault(key, point)
            known["seconds"] = min(known["seconds"], point["seconds"])
    return list(best.values())


def seconds_to(target, curve):
    """Seconds in which a curve reaches an error, between points by their slope in logarithms; None if it does not."""
    found = [point["seconds"] for point in curve if point["error"] <= target]
    for coarse, fine in zip(curve, curve[1:]):
        if coarse["error"] > target > fine["error"] and fine["seconds"] > coarse["seconds"]:
            part = math.log(target / coarse["error"]) / math.log(fine["error"] / coarse["error"])
            found.append(coarse["seconds"] * (fine["seconds"] / coarse["seconds"]) ** part)
    return min(found, default=None)


def at_one_millisecond(curve):
    """Cost of a step [µs] and error of the run with steps of 1 ms."""
    for point in curve:
        if point["dial"] in ("1.000e-3 s", "0.001") and "control" not in point["variant"]:
            return [f"{1e6 * point['seconds'] / 2000:.3g}", f"{point['error']:.1e}"]
    return ["–", "–"]


def errors_table(stages, points):
    """One row per curve, one column per error, the lowest of each in bold (the floor apart)."""
    curves = {}
    for point in points:
        curves.setdefault((point["tool"], point["variant"]), []).append(point)
    times = {name: [seconds_to(target, curve) for target in TARGETS] for name, curve in curves.items()}
    contenders = [row for (tool, _), row in times.items() if tool != "floor"]
    columns = [[row[k] for row in contenders if row[k] is not None] for k in range(len(TARGETS))]
    lowest = [min(column, default=None) for column in columns]
    rows = []
    for (tool, variant), row in times.items():
        cells = [f"{tool}: {variant}"]
        for seconds, best in zip(row, lowest):
            is_best = tool != "floor" and seconds is not None and seconds == best
            cells.append(f"**{digits(seconds)}**" if is_best else digits(seconds))
        rows.append(cells + at_one_millisecond(curves[tool, variant]))
    errors = [f"{target:.0e} m" for target in TARGETS]
    return table([f"N = {stages}", *errors, "µs per step of 1 ms", "its error [m]"], rows)


def tables(python, sizes, limit, passes, floor):
    """A table for each size, one after the other."""
    errors = {}
    for stages in sizes:
        points = measure(python, stages, limit, passes, floor)
        if stages <= FULL:
            errors = {(p["tool"], p["variant"], p["dial"]): p["error"] for p in points}
        for point in points:
            if point["error"] is None:
                point["error"] = errors.get((point["tool"], point["variant"], point["dial"]))
        yield errors_table(stages, [point for point in points if point["error"] is not None])
