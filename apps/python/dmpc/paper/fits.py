"""Fits to cells of Table 3: prices of the machine, by least squares, and a law of two parameters."""

import math
from dataclasses import dataclass

# Four cells of two scenes determine three numbers, so operations are tied together in the proportions of one core of today. A price here
# is a multiple of what the preset ipsc2-1994 has.
TIED = {"walk": ("cell_step", "bvh_node_read", "triangle_test", "sphere_test", "cone_test"), "rays": ("ray_setup", "shading"),
        "cached_lookup": ("cached_lookup",)}
_LEAST_PIVOT = 1e-9  # of rows scaled to a diagonal of 1


@dataclass(frozen=True)
class RayTime:
    """The time of a ray in a run with travelling pages, in node-milliseconds, as a function of the prices."""

    per_price: tuple  # idle time for want of work grows in proportion to computing
    rest: float  # messages and waits for pages, as in the run
    printed: float = 0.0

    def milliseconds(self, prices):
        return self.rest + sum(factor * price for factor, price in zip(self.per_price, prices))


def ray_time(result, preset_ps, printed=0.0):
    """Of a run on ipsc2-1994, whose prices are `preset_ps`."""
    computing = result.percent["computing"]
    idle = result.percent["starvation"] + result.percent["idle_at_end"]
    longer = 1 + idle / computing if computing > 0 else 1
    spent = {name: 1e-9 * count * preset_ps[name] * longer / result.rays for name, count in result.charges.items()}
    tied = [sum(spent.pop(name, 0.0) for name in names) for names in TIED.values()]
    rest = 1e-6 * result.ns * result.nodes * (100 - computing - idle) / 100 / result.rays
    return RayTime(tuple(tied), rest + sum(spent.values()), printed)


def fit_prices(cells):
    """The non-negative prices with the least squares of relative errors; those that the cells do not determine are 0."""
    best = (0.0,) * len(TIED)
    for used in range(1, 1 << len(TIED)):
        prices = _best_prices(cells, [index for index in range(len(TIED)) if used >> index & 1])
        if prices and min(prices) >= 0 and _squares(cells, prices) < _squares(cells, best):
            best = prices
    return best


def _squares(cells, prices):
    return sum((cell.milliseconds(prices) / cell.printed - 1) ** 2 for cell in cells)


def _best_prices(cells, used):
    """If all other prices are 0; nothing if the cells leave them open."""
    rows = [[cell.per_price[index] / cell.printed for index in used] for cell in cells]
    scale = [math.hypot(*column) for column in zip(*rows)]
    if not all(scale):
        return None
    rows = [[factor / size for factor, size in zip(row, scale)] for row in rows]
    goals = [(cell.printed - cell.rest) / cell.printed for cell in cells]
    normal = [[sum(row[i] * row[j] for row in rows) for j in range(len(used))] + [sum(row[i] * goal for row, goal in zip(rows, goals))]
              for i in range(len(used))]
    found = _solution(normal)
    prices = dict(zip(used, (value / size for value, size in zip(found, scale)))) if found else {}
    return tuple(prices.get(index, 0.0) for index in range(len(TIED))) if prices else None


def _solution(rows):
    """Of linear equations, each with its right side last; nothing if they are dependent."""
    for i in range(len(rows)):
        pivot = max(range(i, len(rows)), key=lambda row: abs(rows[row][i]))
        if abs(rows[pivot][i]) < _LEAST_PIVOT:
            return None
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for row in range(len(rows)):
            if row != i:
                factor = rows[row][i] / rows[i][i]
                rows[row] = [value - factor * other for value, other in zip(rows[row], rows[i])]
    return [row[-1] / row[i] for i, row in enumerate(rows)]


def calibrated(one, two, dearer, printed):
    """Factors for the prices of all operations and, beyond that, for a cached look-up, that turn the seconds `one` and `two` of one node
    and two into the printed ones; `dearer` is `two` with the price of a cached look-up doubled. Nothing if no price gives these."""
    if dearer <= two:
        return None
    operations = printed[0] / one
    change = (printed[1] / operations - two) / (dearer - two)
    return (operations, 1 + change) if change >= -1 else None


@dataclass(frozen=True)
class Law:
    """N nodes take one_node * (1 + dearer * (N - 1) / N) node-seconds: (N - 1) / N of the references are to pages of other nodes, whose
    look-ups are dearer; there are neither misses nor an idle end. A prediction has to beat it."""

    one_node: float
    dearer: float

    def seconds(self, nodes):
        return self.one_node * (1 + self.dearer * (nodes - 1) / nodes) / nodes


def law_machines(scene):
    """A scene's two smallest machines, one for each parameter."""
    return tuple(scene.seconds)[:2]


def law_of(scene):
    """The law through them; nothing if the scene has only one."""
    machines = law_machines(scene)
    if len(machines) < 2:
        return None
    (x, y), (x2, y2) = (((nodes - 1) / nodes, scene.seconds[nodes] * nodes) for nodes in machines)
    slope = (y2 - y) / (x2 - x)
    return Law(y - slope * x, slope / (y - slope * x))
