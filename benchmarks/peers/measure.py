"""Processor time and error of one run, alike for all tools."""

import argparse
import json
import sys
import time

import numpy as np

from scene import SAMPLE, SAMPLES, read

FIRST = 10  # samples of a run that only costs are taken of


def largest_distance(positions, converged):
    """Largest distance of a node from where it should be, over all samples [m]."""
    return float(np.linalg.norm(positions - converged, axis=-1).max())


def sampled(advance, positions, converged, samples):
    """Runs this many samples of 10 ms: `advance(k)` goes to sample k and is timed, `positions()` gives the free nodes.

    Returns the seconds that 2 s of motion take (the median sample times their number) and the error up to there; None
    if the run fails.
    """
    times, seen = [], [positions()]
    for k in range(1, samples + 1):
        before = time.process_time()
        advance(k)
        times.append(time.process_time() - before)
        seen.append(positions())
        if not np.isfinite(seen[-1]).all():
            return None
    return float(np.median(times)) * (SAMPLES - 1), largest_distance(np.array(seen), converged[: len(seen)])


def attempt(tool, run, mast, variant, dial, samples):
    """A tool's own failure ends its run, not the comparison."""
    try:
        return run(mast, variant, dial, samples)
    except Exception as error:
        print(f"{tool}, {variant}, {dial}: {error}", file=sys.stderr)
        return None


def full(tool, run, mast, variant, dials, limit):
    """Points of whole runs, coarse to fine, until the next would take longer than the limit: about twice the last."""
    for dial in dials:
        result = attempt(tool, run, mast, variant, dial, SAMPLES - 1)
        if result is not None:
            seconds, error = result
            yield dict(dial=f"{dial:g}", seconds=seconds, error=error)
            if 2 * seconds > limit:
                return


def costs(tool, run, mast, variant, dials, limit):
    """Costs alone, of the first samples; once they take a quarter of the limit, the cost of a step times the steps.

    A tool that controls its error makes more steps at the start than later, and runs in full.
    """
    if "control" in variant:
        yield from full(tool, run, mast, variant, dials, limit)
        return
    last = None
    for dial in dials:
        if last is not None and last[1] * FIRST / (SAMPLES - 1) > limit / 4:
            seconds = last[1] * last[0] / dial
        else:
            result = attempt(tool, run, mast, variant, dial, FIRST)
            if result is None:
                continue
            seconds = result[0]
            last = dial, seconds
        yield dict(dial=f"{dial:g}", seconds=seconds, error=None)


def main(tool, settings, run):
    """Runs a tool over its settings (variant: dials, coarse to fine) and prints the points as JSON lines.

    `run(mast, variant, dial, samples)` returns what `sampled` returns.
    """
    parser = argparse.ArgumentParser(description=f"The mast in {tool}: error against processor time.")
    parser.add_argument("folder", help="where mast-N.json and mast-N-converged.json are")
    parser.add_argument("stages", type=int)
    parser.add_argument("--limit", type=float, default=4.0, help="seconds of a run after which a curve ends")
    parser.add_argument("--costs", action="store_true", help="costs of the first samples alone, for large masts")
    arguments = parser.parse_args()
    mast = read(arguments.folder, arguments.stages)
    points = costs if arguments.costs else full
    for variant, dials in settings.items():
        for point in points(tool, run, mast, variant, dials, arguments.limit):
            print(json.dumps(dict(tool=tool, variant=variant) | point), flush=True)


def steps_per_sample(step):
    """Whole steps within a sample."""
    return round(SAMPLE / step)
