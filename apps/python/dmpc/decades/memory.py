"""The memories of a scene's nodes: eight steps from the least with which pages work to what whole copies need."""

import re

from .. import program
from . import design, runs

_PAGES = (("page-size", "1KiB"), ("in-flight", "1"))


def steps_of(kept, scene, nodes):
    """Bytes of a node, by step. Raises a program.Error if dmpc does not name the least memory."""
    cell = design.Cell("map", "hdr", 0, nodes, "whitted", (scene,))
    lines = [runs.line_of(cell, scene, 1024, "svm", _PAGES), runs.line_of(cell, scene, 1024, "replicated", (("page-size", "4KiB"),))]
    least, whole = (_least_in(one) for one in kept.get(lines))
    return [round(least * (whole / least) ** (step / design.WHOLE)) for step in range(design.WHOLE)] + [whole]


def _least_in(result):
    found = re.search(r"smallest that works is --node-memory=(\d+)B", result.get("misfit", ""))
    if not found:
        raise program.Error(f"{result['line']}: dmpc names no least memory")
    return int(found[1])
