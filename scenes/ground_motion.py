#!/usr/bin/env python3
"""Makes ground_motion.csv: an artificial accelerogram of firm ground, the same on every machine.

    python3 scenes/ground_motion.py > scenes/ground_motion.csv

White noise passes the Kanai-Tajimi filter, the absolute acceleration of an oscillator on shaken rock (frequency WG,
damping ZG: Kanai 1957, Tajimi 1960), then the high-pass filter of Clough and Penzien (WF, ZF), which takes out slow motion
so that the displacement stays finite; an envelope makes it rise, last and decay (Jennings, Housner, Tsai 1968). The
result is scaled to a peak ground acceleration of PEAK.
"""

import math
import random

DT, DURATION = 0.01, 20.0  # s
WG, ZG = 5.0 * math.pi, 0.6  # rad/s, 1: firm ground
WF, ZF = 0.5 * math.pi, 0.6
RISE, STRONG, DECAY = 3.0, 10.0, 0.6  # s, s, 1/s
PEAK = 3.0  # m/s²


def noise(count):
    """Normal numbers by Box and Muller; random() of a seed is the same in all versions of Python."""
    source = random.Random(1957)
    return [
        math.sqrt(-2.0 * math.log(1.0 - source.random())) * math.cos(2.0 * math.pi * source.random())
        for _ in range(count)
    ]


def oscillator(force, w, z):
    """Displacement and velocity of x'' + 2 z w x' + w² x = force, by the average acceleration method (Newmark, 1/4)."""
    x, v = 0.0, 0.0
    a = force[0]
    motion = [(x, v)]
    for f in force[1:]:
        x_predicted = x + DT * v + DT * DT / 4.0 * a
        v_predicted = v + DT / 2.0 * a
        a = (f - 2.0 * z * w * v_predicted - w * w * x_predicted) / (1.0 + z * w * DT + (w * DT / 2.0) ** 2)
        x = x_predicted + DT * DT / 4.0 * a
        v = v_predicted + DT / 2.0 * a
        motion.append((x, v))
    return motion


def envelope(t):
    if t < RISE:
        return (t / RISE) ** 2
    return math.exp(-DECAY * max(0.0, t - STRONG))


def main():
    times = [DT * k for k in range(round(DURATION / DT) + 1)]
    rock = [envelope(t) * w for t, w in zip(times, noise(len(times)))]
    ground = [2.0 * ZG * WG * v + WG * WG * x for x, v in oscillator(rock, WG, ZG)]
    # A slow oscillator's acceleration relative to the ground, with the sign turned: only what is fast is left.
    slow = oscillator([-a for a in ground], WF, ZF)
    fast = [a + 2.0 * ZF * WF * v + WF * WF * x for a, (x, v) in zip(ground, slow)]
    scale = PEAK / max(abs(a) for a in fast)
    print("# Artificial ground motion, made by ground_motion.py; peak ground acceleration %.2f m/s²." % PEAK)
    print("t,a")
    for t, a in zip(times, fast):
        print("%.2f,%.5f" % (t, scale * a))


main()
