"""To which price a cell's lead is most sensitive: least squares over its draws."""

import json
import math

import numpy

from .. import program
from ..studies.runs import at

_GROUPS = {"processor, per message": ("long_message", "send_ns"), "latency and bandwidth": ("long_message", "latency_ns"),
           "short messages": ("short_message", "latency_ns"), "a hop": ("hop_ns",), "page service": ("service_ns",),
           "computing": ("operation_ps", "bvh_node_read"), "look-up of a cached page": ("operation_ps", "cached_lookup"),
           "installing a page": ("operation_ps", "page_install"), "packing a ray": ("operation_ps", "ray_packing")}


class Prices:
    """The factors of each price group in each draw of a machine."""

    def __init__(self):
        self._machines, self._factors = {}, {}

    def factors(self, machine, draw):
        if (machine, draw) not in self._factors:
            base, drawn = self._machine(machine, None), self._machine(machine, draw)
            self._factors[machine, draw] = {name: math.log(at(drawn, path) / at(base, path)) for name, path in _GROUPS.items()
                                            if at(base, path) > 0}
        return self._factors[machine, draw]

    def _machine(self, machine, draw):
        if (machine, draw) not in self._machines:
            self._machines[machine, draw] = json.loads(program.run(["machine", machine] + ([] if draw is None else [f"--draw={draw}"])))
        return self._machines[machine, draw]


def turning(prices, verdict):
    """The price to which the lead is most sensitive within its doubt, the exponent of the lead, and the factor on that price that would
    make it a tie; nothing without draws, or if the price has no doubt."""
    if not verdict.times:
        return None
    rows = [prices.factors(verdict.cell.machine, number) for number in range(len(verdict.times))]
    names = [name for name in rows[0] if any(abs(row[name]) > 1e-9 for row in rows)]
    names = [name for index, name in enumerate(names)
             if not any(all(abs(row[name] - row[other]) < 1e-3 for row in rows) for other in names[:index])]
    if len(rows) < 2 * (len(names) + 1):
        return None  # of more prices than so few draws can tell apart
    matrix = numpy.array([[row[name] for name in names] + [1.0] for row in rows])
    logs = numpy.log(verdict.factors)
    ridge = 1e-3 * numpy.eye(len(names) + 1)
    ridge[-1, -1] = 0
    exponents = numpy.linalg.solve(matrix.T @ matrix + ridge, matrix.T @ logs)
    spread = numpy.std(matrix[:, :-1], axis=0)
    most = int(numpy.argmax(numpy.abs(exponents[:-1]) * spread))
    exponent = float(exponents[most])
    turn = -math.log(verdict.lead) / exponent if abs(exponent) > 0.02 and math.isfinite(verdict.lead) else None
    return names[most], exponent, math.exp(turn) if turn is not None and abs(turn) < math.log(1000) else None
