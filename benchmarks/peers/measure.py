"""Processor time and error of one run, alike for all tools."""

import argparse
import json
import sys
import time

import numpy as np

from scene import SAMPLE, SAMPLES, read


def largest_distance(positions, converged):
    """Largest distance of a node from where it should be, over all samples [m]."""
    return float(np.linalg.norm(positions - converged, axis=-1).max())


def sampled(advance, positions, converged, patience):
    """Runs 2 s in samples of 10 ms.

    `advance(k)` goes to sample k and is timed; `positions()` gives the free nodes and is not. After `patience` seconds the
    run is cut: cost is then that of the samples made, and the error that up to there. Returns seconds for the 2 s (the median
    sample times their number), error, and samples made.
    """
    times, seen = [], [positions()]
    start = time.process_time()
    for k in range(1, SAMPLES):
        before = time.process_time()
        advance(k)
        times.append(time.process_time() - before)
        seen.append(positions())
        if not np.isfinite(seen[-1]).all():
            return None
        if time.process_time() - start > patience:
            break
    seconds = float(np.median(times)) * (SAMPLES - 1)
    return seconds, largest_distance(np.array(seen), converged[: len(seen)]), len(times)


def main(tool, settings, run):
    """Runs a tool over its settings (variant, dial), coarse to fine, and prints the points as JSON lines.

    `run(mast, variant, dial, patience)` returns what `sampled` returns, None for a run that fails.
    """
    parser = argparse.ArgumentParser(description=f"The mast in {tool}: error against processor time.")
    parser.add_argument("folder", help="where mast-N.json and mast-N-converged.json are")
    parser.add_argument("stages", type=int)
    parser.add_argument("--limit", type=float, default=4.0, help="seconds of a run after which a curve ends")
    arguments = parser.parse_args()
    mast = read(arguments.folder, arguments.stages)
    for variant, dials in settings.items():
        for dial in dials:
            try:
                result = run(mast, variant, dial, arguments.limit)
            except Exception as error:  # a tool's own failure ends its run, not the comparison
                print(f"{tool}, {variant}, {dial}: {error}", file=sys.stderr)
                continue
            if result is None:
                continue
            seconds, error, samples = result
            point = dict(tool=tool, variant=variant, dial=f"{dial:g}", seconds=seconds, error=error, samples=samples)
            print(json.dumps(point), flush=True)
            if 2 * seconds > arguments.limit:
                break


def steps_per_sample(step):
    """Whole steps within a sample."""
    return round(SAMPLE / step)
