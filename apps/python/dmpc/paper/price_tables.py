"""Tables of prices: those of the machines beside fits of them to cells of Table 3."""

from itertools import combinations
from statistics import mean

from .data import SCENES
from .fits import TIED, calibrated, fit_prices, ray_time
from .tables import cells_of, table_of

_FIGURES = {"cell_step": "a step to the next voxel, its entry read", "triangle_test": "a reference read and its polygon tested",
            "ray_setup": "a ray set up", "shading": "a hit shaded",
            "cached_lookup": "a look-up of a page that is not at home, beyond one that is"}


def _priced(machine_ps, prices):
    """Whole picoseconds of the operations whose prices are fitted."""
    return {name: round(factor * machine_ps[name]) for names, factor in zip(TIED.values(), prices) for name in names}


def _ray_times(cells, machine_ps):
    return {(cell.scene.title, cell.nodes): ray_time(cell.found, machine_ps, cell.printed_ray) for cell in cells}


def _change(before, after):
    return 100 * (after / before - 1)


def voxel_prices(found, machine_ps):
    """The prices of ipsc2-1994 beside those that its four cells require."""
    cells = cells_of(found, "article")
    times = _ray_times(cells, machine_ps)
    fit = _priced(machine_ps, fit_prices([times[cell.scene.title, cell.nodes] for cell in cells if cell.is_fitted]))
    return table_of(
        "Prices: Mountain on 1 and 64 nodes, Rings4 on 2 and 64", ("figure", "on the machine|us|1", "fitted|us|1", "change|%|2"),
        [[name, 1e-6 * machine_ps[figure], 1e-6 * fit[figure], _change(machine_ps[figure], fit[figure])]
         for figure, name in _FIGURES.items()],
        "Four cells of two scenes have two levels and two slopes over nodes. Both slopes are the dearer look-up's, whatever else a further "
        "node costs there; two levels tell two numbers of what a ray does. So steps are tied to tests, and rays to hits, in the "
        "proportions that one core of today has: a step of 7.5 ns, a reference and its polygon as a record read and a test, 14.7 and 3.7 "
        "ns; 55 ns a ray, 167 ns a hit. Each reference that is read has its polygon tested, so no count can tell them apart.",
        "The machine is ipsc2-1994; what pages and messages cost is as on ipsc2.",
        "The printed times are those of 512x512 pixels: with any other --resolution the fitted prices mean nothing.")


def voxel_pairs(found, machine_ps):
    """Predictions for all cells from prices fitted to any two scenes, smallest and largest machine."""
    cells = cells_of(found, "article")
    times = _ray_times(cells, machine_ps)
    rows = []
    for pair in combinations(SCENES, 2):
        prices = fit_prices([times[cell.scene.title, cell.nodes] for cell in cells
                             if cell.scene.title in pair and (cell.is_base or cell.nodes == 64)])
        ratios = {key: time.milliseconds(prices) / time.printed for key, time in times.items()}
        errors = [abs(ratio - 1) for ratio in ratios.values()]
        us = {name: 1e-6 * ps for name, ps in _priced(machine_ps, prices).items()}
        rows.append([", ".join(pair), us["cell_step"], us["triangle_test"], 1e-3 * us["ray_setup"], 1e-3 * us["shading"],
                     us["cached_lookup"], *(mean(ratio for (title, _), ratio in ratios.items() if title == scene) for scene in SCENES),
                     100 * mean(errors), 100 * max(errors)])
    return table_of(
        "Times of a ray over printed ones, by prices fitted to any two scenes",
        ("fitted to", "step|us|0", "test|us|0", "ray|ms|2", "hit|ms|2", "look-up|us|1", *(f"{title}||2" for title in SCENES),
         "mean error|%|1", "worst error|%|1"), rows,
        "Fits, not predictions, from runs on ipsc2-1994: the time of a ray is linear in its prices, nodes idle in proportion to what they "
        "compute, and messages and waits for pages are left as they were. Smallest and largest machine of each scene, of Tetra10 its one "
        "cell. Of each scene the mean over its cells, the errors over all.")


def calibration(found, machine_ps):
    """Both figures of ipsc2 that are fitted to two cells, as in the preset and as the printed times require."""
    scene = SCENES["Mountain"]
    one, two, dearer = (found[key].seconds for key in (("grid", scene.title, 1), ("grid", scene.title, 2), "dearer"))
    fit = calibrated(one, two, dearer, (scene.seconds[1], scene.seconds[2]))
    rows = []
    if fit:
        fitted = {name: round(ps * fit[0]) for name, ps in machine_ps.items()}
        fitted["cached_lookup"] = round(fitted["cached_lookup"] * fit[1])
        rows = [[name, 1e-3 * machine_ps[figure], 1e-3 * fitted[figure], _change(machine_ps[figure], fitted[figure])] for figure, name in (
            ("cell_step", "a cell step, and all other operations in proportion"), ("cached_lookup", "a look-up of a cached page"))]
    return table_of(
        "Calibration of ipsc2 on dmpc's grid: Mountain on one node and on two",
        ("figure", "in the preset|ns|1", "fitted|ns|1", "change|%|2"), rows,
        *(() if fit else ("No price of a cached look-up gives the printed time here.",)),
        "The printed times are those of 512x512 pixels: with any other --resolution the fitted figures mean nothing.")
