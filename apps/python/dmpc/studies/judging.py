"""What may be said of times: ties, how many draws of a machine's prices a winner needs, and pictures that are too small to tell."""

import math

TIE = 0.01  # times that differ by no more than this share are equal
DECIDED = 0.8  # of the draws in which a winner has to stay ahead
_SMALL = 0.5  # of the time: more in the host, or in film and end, and they decide in place of pages and rays
ONE_COMPUTER = ("ipsc2", "ipsc2-1994")  # whose prices belong to a structure


def is_tie(first, second):
    """Of the seconds of two runs; infinite ones, of a run that had no room, are no tie."""
    return abs(first - second) <= TIE * second < math.inf


def is_faster(first, second):
    """By more than a tie."""
    return first < second and not is_tie(first, second)


def priced_for(machine, structure):
    """The machine, or the preset of the same computer whose prices are for this structure."""
    return ONE_COMPUTER[structure == "voxels"] if machine in ONE_COMPUTER else machine


def small(result):
    """What decides a run in place of rays and pages: "host", "film" or "end", or nothing, if film and end take at most half of the nodes'
    time and the host is busy for at most half of the run."""
    if result["host"] > _SMALL:
        return "host"
    film, end = result["share"]["film_wait"], result["share"]["idle_at_end"]
    if film + end <= 100 * _SMALL:
        return None
    return "film" if film >= end else "end"


def small_text(result):
    """nodes wait for film or are idle at the end for 73 % of the time."""
    which = small(result)
    if which == "host":
        return f"the host is busy for {100 * result['host']:.0f} % of the time"
    lost = result["share"]["film_wait"] + result["share"]["idle_at_end"]
    who = "nodes wait for film or are idle at the end" if which == "film" else "nodes are idle at the end or wait for film"
    return f"{who} for {lost:.0f} % of the time"


def remedy(result, width, height, samples):
    """The picture that would do: --samples=3. The film's way takes as long with more samples, while all else grows with them; what is left
    at the end is a few work items, which are as long in a larger picture, so that its area has to grow."""
    share = {name: percent / 100 for name, percent in result["share"].items()}
    which, lost = small(result), share["film_wait"] + share["idle_at_end"]
    growth = lost / max(1 - lost, 1e-3)
    if which == "host":
        growth = result["host"] / (_SMALL * max(share["computing"], 1e-3))
    if which != "end":
        return f"--samples={math.ceil(growth * samples)}"
    side = math.sqrt(growth)
    return f"--resolution={math.ceil(side * width)}x{math.ceil(side * height)}"
