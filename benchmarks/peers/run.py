#!/usr/bin/env python3
"""Error against processor time on the prism mast, for other tools and for this workspace, in one run on one machine.

    python3 benchmarks/peers/run.py --write

makes a virtual environment in target/bench with the versions of requirements.txt (a few hundred MB; --python names an
interpreter that has them already), lets `cargo xtask` write the scene and its converged trajectory, runs all tools in
turn, twice, and prints a table for each size; --write puts them into docs/performance.md. Takes about ten minutes.
"""

import argparse
import datetime
import json
import math
import os
import subprocess
import sys
import venv
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
PAGE = ROOT / "docs" / "performance.md"
TOOLS = ["mujoco_mast.py", "drake_mast.py", "exudyn_mast.py"]
FULL = 32  # largest mast on which other tools make whole runs; beyond, errors are those of this one
TARGETS = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8]
# One thread for every tool.
ENVIRONMENT = os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}


def target_folder():
    return Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")).resolve()


def interpreter(given):
    """A Python that has the tools."""
    if given:
        return given
    folder = target_folder() / "bench" / "peers"
    python = folder / "bin" / "python"
    if not python.exists():
        venv.create(folder, with_pip=True)
        subprocess.run([python, "-m", "pip", "install", "--quiet", "-r", HERE / "requirements.txt"], check=True)
    return python


def xtask(*arguments):
    command = ["cargo", "xtask", *map(str, arguments)]
    return subprocess.run(command, cwd=ROOT, env=ENVIRONMENT, check=True, capture_output=True, text=True).stdout


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


def digits(x):
    return "–" if x is None else f"{x:.2g}" if x >= 1e-3 else f"{x:.1e}"


def at_one_millisecond(curve):
    """Cost of a step [µs] and error of the run with steps of 1 ms."""
    for point in curve:
        if point["dial"] in ("1.000e-3 s", "0.001") and "control" not in point["variant"]:
            return [f"{1e6 * point['seconds'] / 2000:.3g}", f"{point['error']:.1e}"]
    return ["–", "–"]


def table(stages, points):
    """One row per curve, one column per error, the lowest of each in bold (the floor apart)."""
    curves = {}
    for point in points:
        curves.setdefault((point["tool"], point["variant"]), []).append(point)
    times = {name: [seconds_to(target, curve) for target in TARGETS] for name, curve in curves.items()}
    contenders = [row for (tool, _), row in times.items() if tool != "floor"]
    columns = [[row[k] for row in contenders if row[k] is not None] for k in range(len(TARGETS))]
    lowest = [min(column, default=None) for column in columns]
    header = [f"N = {stages}", *(f"{target:.0e} m" for target in TARGETS), "µs per step of 1 ms", "its error [m]"]
    lines = [f"| {' | '.join(header)} |", "|---|" + "---:|" * (len(header) - 1)]
    for (tool, variant), row in times.items():
        cells = [f"{tool}: {variant}"]
        for seconds, best in zip(row, lowest):
            is_best = tool != "floor" and seconds is not None and seconds == best
            cells.append(f"**{digits(seconds)}**" if is_best else digits(seconds))
        cells += at_one_millisecond(curves[tool, variant])
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


def machine():
    """One line: processor, cores, versions, date."""
    lines = Path("/proc/cpuinfo").read_text().splitlines()
    model = next((line.split(": ")[1] for line in lines if line.startswith("model name")), "unknown processor")
    rustc = subprocess.check_output(["rustc", "--version"], text=True).strip()
    versions = ", ".join((HERE / "requirements.txt").read_text().split())
    return f"{model}, {os.cpu_count()} cores; {rustc}; {versions}; {datetime.date.today()}"


def insert(text):
    """Replaces what stands between the markers of the page."""
    start, end = "<!-- peers: generated -->\n", "<!-- peers: end -->"
    before, rest = PAGE.read_text().split(start)
    after = rest.split(end)[1]
    PAGE.write_text(f"{before}{start}\n{text.strip()}\n\n{end}{after}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--python", help="an interpreter that has the tools")
    parser.add_argument("--floor", help="source of the floor program (cargo xtask bench --help)")
    parser.add_argument("--stages", type=int, nargs="+", default=[2, 8, 32, 128])
    parser.add_argument("--limit", type=float, default=4.0, help="seconds of a run after which a curve ends")
    parser.add_argument("--passes", type=int, default=2)
    parser.add_argument("--write", action="store_true", help="write the tables into docs/performance.md")
    arguments = parser.parse_args()
    python = interpreter(arguments.python)
    effort = f"runs of about {arguments.limit:g} s at most, passes: {arguments.passes}"
    parts = [f"Measured on: {machine()}; {effort}.\n"]
    errors = {}
    for stages in arguments.stages:
        points = measure(python, stages, arguments.limit, arguments.passes, arguments.floor)
        if stages <= FULL:
            errors = {(p["tool"], p["variant"], p["dial"]): p["error"] for p in points}
        for point in points:
            if point["error"] is None:
                point["error"] = errors.get((point["tool"], point["variant"], point["dial"]))
        points = [point for point in points if point["error"] is not None]
        parts.append(table(stages, points) + "\n")
        print(parts[-1], flush=True)
    if arguments.write:
        insert("\n".join(parts))


if __name__ == "__main__":
    main()
