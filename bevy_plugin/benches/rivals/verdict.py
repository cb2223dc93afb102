"""Who is faster at the same error, from what was measured.

A run has `seconds` and `rms`. The error at which both are compared is 2 %, or that of Cycles at its most samples where that
is larger.
"""

import math

GOAL_ERROR = 0.02
# Settings whose errors differ by less are equally good: the errors themselves are known to a twentieth and worse.
ALIKE = 1.1
GOAL_MEAN, GOAL_EACH, GOAL_EMBREE = 50, 20, 1.25


def common_error(cycles):
    """
    >>> common_error([{"samples": 16, "rms": 0.14}, {"samples": 256, "rms": 0.04}])
    0.04
    >>> common_error([{"samples": 16, "rms": 0.03}, {"samples": 64, "rms": 0.015}])
    0.02
    """
    return max(GOAL_ERROR, max(cycles, key=lambda run: run["samples"])["rms"])


def seconds_at(error, cycles):
    """Seconds of Cycles at an error: between two measured ones by a power law, beyond them by time ~ error^-2.

    Noise that falls with the square root of the time is met exactly:

    >>> runs = [{"seconds": 1.0, "rms": 0.08}, {"seconds": 4.0, "rms": 0.04}]
    >>> [round(seconds_at(error, runs), 6) for error in (0.08, 0.05, 0.04, 0.01, 0.16)]
    [1.0, 2.56, 4.0, 64.0, 0.25]
    """
    runs = sorted(cycles, key=lambda run: run["seconds"])
    for fast, slow in zip(runs, runs[1:]):
        if fast["rms"] > slow["rms"] and slow["rms"] <= error <= fast["rms"]:
            share = math.log(fast["rms"] / error) / math.log(fast["rms"] / slow["rms"])
            return fast["seconds"] * (slow["seconds"] / fast["seconds"]) ** share
    end = runs[0] if error > runs[0]["rms"] else runs[-1]
    return end["seconds"] * (end["rms"] / error) ** 2


def fastest(ours, error):
    """The fastest of our settings at or below an error, else nothing.

    >>> ours = [{"seconds": 1.0, "rms": 0.03}, {"seconds": 2.0, "rms": 0.01}]
    >>> fastest(ours, 0.02)["seconds"], fastest(ours, 0.03)["seconds"], fastest(ours, 0.001)
    (2.0, 1.0, None)
    """
    good = [run for run in ours if run["rms"] <= error]
    return min(good, key=lambda run: run["seconds"], default=None)


def nearest(ours):
    """The fastest of our settings with about the least error.

    >>> ours = [{"seconds": 1.0, "rms": 0.4}, {"seconds": 2.0, "rms": 0.31}, {"seconds": 24.0, "rms": 0.3}]
    >>> nearest(ours)["seconds"]
    2.0
    """
    least = min(run["rms"] for run in ours)
    return fastest(ours, ALIKE * least)


def of_scene(ours, cycles):
    """The line of a scene; `reached` tells whether a setting of ours is at or below the common error."""
    error = common_error(cycles)
    reached = fastest(ours, error)
    # Where no setting gets there, the nearest stands against Cycles at its own error, and is marked.
    run = reached or nearest(ours)
    against = error if reached else max(error, run["rms"])
    seconds = seconds_at(against, cycles)
    found = {"error": against, "reached": reached is not None, "ours": run, "cycles_seconds": seconds}
    return found | {"ratio": seconds / run["seconds"], "median_ratio": median_ratio(run, cycles)}


def median_ratio(run, cycles):
    """How much longer Cycles takes for the median error of a run of ours.

    >>> median_ratio({"seconds": 2.0, "p50": 0.02}, [{"seconds": 4.0, "p50": 0.04}])
    8.0
    """
    medians = [{"seconds": one["seconds"], "rms": one["p50"]} for one in cycles]
    return seconds_at(run["p50"], medians) / run["seconds"]


def geometric_mean(values):
    """
    >>> geometric_mean([2.0, 8.0])
    4.0
    """
    return math.exp(sum(map(math.log, values)) / len(values))


def goals(ratios, embree):
    """Each goal as text, and whether it holds."""
    mean, least = geometric_mean(ratios), min(ratios)
    found = [
        (f"geometric mean {mean:.0f}, goal {GOAL_MEAN}", mean >= GOAL_MEAN),
        (f"least {least:.0f}, goal {GOAL_EACH}", least >= GOAL_EACH),
    ]
    if embree:
        most = max(embree)
        found.append((f"at most {most:.2f} times Embree's time for the same rays, goal {GOAL_EMBREE}", most <= GOAL_EMBREE))
    return found
