"""How much Table 3 on dmpc's grid depends on each figure of the modelled machine."""

import copy
from statistics import mean

from ..studies.runs import at
from .catalogue import on_grid
from .data import SCENES, efficiency
from .tables import table_of

WATCHED = (("Mountain", 2), ("Mountain", 64), ("Rings4", 64), ("Tetra9", 32), ("Tetra9", 64))  # cells whose efficiencies are compared
# Operations whose prices affect Table 3's runs: no spheres, cones or travelling rays.
_OPERATIONS = {"ray_setup": "ray set-up", "cell_step": "cell step", "bvh_node_read": "BVH node read", "triangle_test": "triangle test",
               "shading": "shading", "cached_lookup": "cached look-up", "page_install": "page install"}
_SHORT, _LONG = "short_message", "long_message"
# Figures of messages with their picoseconds: keys of a machine's file.
_MESSAGES = {"short message latency": (1000, (_SHORT, "latency_ns")), "long message latency": (1000, (_LONG, "latency_ns")),
             "a byte": (1, (_SHORT, "byte_ps"), (_LONG, "byte_ps")), "send overhead": (1000, (_SHORT, "send_ns"), (_LONG, "send_ns")),
             "receive overhead": (1000, (_SHORT, "receive_ns"), (_LONG, "receive_ns")), "a hop": (1000, ("hop_ns",)),
             "interrupt service": (1000, ("service_ns",))}


def _changed(machine, paths, value_of):
    machine = copy.deepcopy(machine)
    for path in paths:
        at(machine, path[:-1])[path[-1]] = value_of(at(machine, path))
    return machine


def _time_text(ps):
    return f"{1e-3 * ps:.1f} ns" if ps < 1e6 else f"{1e-6 * ps:.1f} us"


def variations(machine):
    """(figure, its value, change) -> machine: each price other than zero a fifth lower and higher, all of them together, the figures of
    messages and of the interrupt likewise, a home look-up, which is free, at a fifth of a cached one's price, and no contention. The value
    is missing where there is no single one."""
    prices = machine["operation_ps"]
    scaled = [("all operations", None, [("operation_ps", name) for name in prices])]
    scaled += [(text, _time_text(prices[name]), [("operation_ps", name)]) for name, text in _OPERATIONS.items() if prices[name]]
    after = [(text, " and ".join(dict.fromkeys(_time_text(unit * at(machine, path)) for path in paths)), paths)
             for text, (unit, *paths) in _MESSAGES.items()]
    fifths = {"-20 %": 4, "+20 %": 6}

    def both(figures):
        return {(text, value, change): _changed(machine, paths, lambda figure, factor=factor: figure * factor // 5)
                for text, value, paths in figures for change, factor in fifths.items()}

    home = ("operation_ps", "home_lookup")
    return {**both(scaled),
            ("home look-up", _time_text(prices["home_lookup"]), "a fifth of a cached one's"):
                _changed(machine, [home], lambda figure: figure + prices["cached_lookup"] // 5),
            **both(after), ("contention for links", None, "off"): _changed(machine, [("has_contention",)], lambda figure: False)}


def cells():
    """The watched ones and what they are held against."""
    return tuple(dict.fromkeys((title, nodes) for title, watched in WATCHED for nodes in (SCENES[title].base, watched)))


def runs(side, pages, count):
    """Of `count` variations, whose machines are files by their numbers."""
    return {("varied", number, title, nodes): on_grid(side, pages, title, nodes, machine=f"machines/varied-{number}.json")
            for number in range(count) for title, nodes in cells()}


def _watched(found, *kind):
    """Efficiencies of the watched cells, and the mean and the worst of their differences from the printed ones."""
    efficiencies = [efficiency(found[*kind, title, base].seconds, base, found[*kind, title, nodes].seconds, nodes)
                    for title, nodes in WATCHED for base in [SCENES[title].base]]
    errors = [abs(each - SCENES[title].efficiency(nodes)) for each, (title, nodes) in zip(efficiencies, WATCHED)]
    return [*efficiencies, mean(errors), max(errors)]


def sensitivity(found, varied):
    """A row for each variation: its effect on the watched cells' efficiencies, and on their differences from the printed ones."""
    before = _watched(found, "grid")
    names = [f"{title} {nodes}" for title, nodes in WATCHED]
    rows = [[*variation, *(after - was for after, was in zip(_watched(found, "varied", number), before))]
            for number, variation in enumerate(varied)]
    shown = ", ".join(f"{name} {each:.2f} %" for name, each in zip(names, before))
    return table_of(
        "Sensitivity: what a figure of ipsc2 does to efficiencies of Table 3 on dmpc's grid",
        ("figure", "in the preset", "change", *(f"{name}|points|2" for name in names), "mean error|points|2", "worst error|points|2"), rows,
        f"By the preset: {shown}, mean error {before[-2]:.2f} points, worst {before[-1]:.2f}. The rows are changes of these, not "
        "calibrated anew.",
        "A home look-up is free in the preset, and a fifth of nothing is nothing: so its row has a fifth of another price.",
        "Spheres, cones and packed rays have prices, too, but Table 3's runs have none of them.")
