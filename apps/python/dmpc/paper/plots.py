"""The plots of the study, by matplotlib: the article's values as marks without a line, ours as lines or bars. Ink is the page's colour."""

import io
from dataclasses import dataclass

from ..studies.runs import PARTS
from .catalogue import CACHES, RINGS
from .data import NODES, SCENES

_INK = "#010203"  # stands for the colour of what surrounds the plot
_COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c6d46", "#f0e442", "#555555", "#882255")
_MARKS = "os^Dv"
_PART_WORDS = {"data_wait": "page wait", "other_wait": "other waits", "service_busy": "service while busy by others' requests",
               "service_idle": "lent to others' requests"}


@dataclass(frozen=True)
class Series:
    label: str
    column: str  # of its numbers
    where: tuple = ()  # the column and the text that its rows have
    colour: int = 0
    is_printed: bool = False


@dataclass(frozen=True)
class Plot:
    """`x` is the column of a horizontal axis, of logarithms to the base `log_x`; without it there are bars, whose places are named by the
    columns `places`."""

    name: str
    title: str
    y: str
    series: tuple
    x: str = ""
    x_label: str = ""
    log_x: int = 2
    places: tuple = ("scene",)
    is_stacked: bool = False
    is_log: bool = False


def _of_table_3(name, title, y, printed, found, scenes, is_log):
    series = [Series(f"{scene}, {words}", column, ("scene", scene), colour, words == "printed") for colour, scene in enumerate(scenes)
              for words, column in (("printed", printed), ("found", found))]
    return Plot(name, title, y, tuple(series), "nodes", "nodes", is_log=is_log)


def _of_caches(name, title, y, column, *more):
    series = [Series(scene, column, ("scene", scene), colour) for colour, scene in enumerate(CACHES)]
    return Plot(name, title, y, (*series, *more), "of the database", "cache of a node (% of the database)", 10)


# By table.
PLOTS = {
    "table_2": (Plot("table_2", "Table 2: pages for a pixel, printed and found", "pages for a pixel",
                     (Series("printed", "pages a pixel printed"), Series("found", "pages a pixel", colour=1))),),
    "table_3": (_of_table_3("table_3_seconds", "Table 3: seconds on the iPSC/2, printed and found", "time (s)", "printed", "found",
                            SCENES, True),
                _of_table_3("table_3", "Table 3: efficiency on the iPSC/2, printed and found", "efficiency (%)", "efficiency printed",
                            "efficiency", [title for title, scene in SCENES.items() if scene.base < NODES[-1]], False)),
    "algorithms": (Plot("algorithms", "Figures 5 and 7: efficiency of both algorithms", "efficiency (%)", tuple(
        Series(f"{scene}, {what} travel", f"{what} travel efficiency", ("scene", scene), colour)
        for colour, (scene, what) in enumerate((scene, what) for scene in RINGS for what in ("pages", "rays"))), "nodes", "nodes"),),
    "caches": (_of_caches("caches", "Figure 8: efficiency by the size of the cache, 32 nodes", "efficiency (%)", "efficiency"),
               _of_caches("misses", "Figure 9: look-ups that miss, 32 nodes", "miss ratio (%)", "miss ratio"),
               _of_caches("traffic", "Figure 10: pages that a node receives and sends, 32 nodes", "of 0.9 MB/s (%)", "traffic both ways",
                          Series("Rings4, printed", "printed", ("scene", "Rings4"), 0, True))),
    "losses": (Plot("losses", "Where the nodes' time goes, computing apart", "of the nodes' time (%)", tuple(
        Series(_PART_WORDS.get(part, part.replace("_", " ")), part, colour=colour) for colour, part in enumerate(PARTS[1:])),
        places=("scene", "nodes"), is_stacked=True),),
    "sensitivity": (Plot("sensitivity", "What a fifth less or more of a figure does to the efficiency on 64 nodes",
                         "change of the efficiency (points)", tuple(
                             Series(f"{scene}, {change}", f"{scene} 64", ("change", change), colour)
                             for colour, (scene, change) in enumerate((scene, change) for scene in ("Mountain", "Rings4", "Tetra9")
                                                                      for change in ("-20 %", "+20 %"))), places=("figure",)),)}


def points(plot, series, table):
    """Place and number of each row that the series has a number in; places are numbers of the axis, or texts."""
    found = []
    for row in table.rows:
        number = table.value(row, series.column)
        if number is not None and (not series.where or table.value(row, series.where[0]) == series.where[1]):
            place = table.value(row, plot.x) if plot.x else " ".join(str(table.value(row, name)) for name in plot.places)
            found.append((place, number))
    return found


def draw(plot, table):
    """As SVG. Raises ModuleNotFoundError without matplotlib."""
    import matplotlib

    matplotlib.use("svg")
    from matplotlib import pyplot

    settings = dict.fromkeys(("text.color", "axes.edgecolor", "axes.labelcolor", "xtick.color", "ytick.color"), _INK)
    with pyplot.rc_context({**settings, "font.size": 9, "svg.fonttype": "none", "svg.hashsalt": plot.name}):
        figure, axis = pyplot.subplots(figsize=(7.5, 4), layout="constrained")
        (_lines if plot.x else _bars)(axis, plot, table)
        axis.set(title=plot.title, ylabel=plot.y, yscale="log" if plot.is_log else "linear")
        axis.spines[["top", "right"]].set_visible(False)
        figure.legend(loc="upper center", bbox_to_anchor=(0.5, 0), ncol=3, frameon=False)
        text = io.StringIO()
        figure.savefig(text, format="svg", transparent=True, bbox_inches="tight", metadata={"Date": None})
        pyplot.close(figure)
    return text.getvalue().replace(_INK, "currentColor")


def _lines(axis, plot, table):
    for series in plot.series:
        found = points(plot, series, table)
        if found:
            style = {"linestyle": "", "markerfacecolor": "none"} if series.is_printed else {"linewidth": 1.2, "markersize": 3}
            axis.plot(*zip(*found), color=_COLOURS[series.colour], marker=_MARKS[series.colour], label=series.label, **style)
    axis.set_xscale("log", base=plot.log_x)
    axis.set_xlabel(plot.x_label)
    if plot.log_x == 2:
        axis.set_xticks(NODES, [str(nodes) for nodes in NODES])


def _bars(axis, plot, table):
    numbers = [(series, dict(points(plot, series, table))) for series in plot.series]
    places = list(dict.fromkeys(place for _, found in numbers for place in found))
    width, low = 0.8 if plot.is_stacked else 0.8 / len(numbers), [0.0] * len(places)
    for index, (series, found) in enumerate(numbers):
        heights = [found.get(place, 0.0) for place in places]
        offset = 0 if plot.is_stacked else (index - (len(numbers) - 1) / 2) * width
        axis.bar([at + offset for at in range(len(places))], heights, width, low if plot.is_stacked else 0.0,
                 color=_COLOURS[series.colour], label=series.label)
        low = [below + height for below, height in zip(low, heights)]
    axis.set_xticks(range(len(places)), places, rotation=45 if len(places) > 6 else 0, ha="right" if len(places) > 6 else "center")
