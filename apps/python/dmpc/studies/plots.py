"""Plots of tables, by matplotlib, which is asked for when a plot is wanted: given values as marks without a line, found ones as lines or
bars. Ink is the colour of the page around it."""

import importlib.util
import io
from dataclasses import dataclass, field

from .. import program
from .runs import PARTS

_INK = "#010203"  # stands for the colour of what surrounds the plot
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c6d46", "#f0e442", "#555555", "#882255", "#88ccee")
_MARKS = "os^Dv"


@dataclass(frozen=True)
class Series:
    label: str
    column: str  # of its numbers
    where: dict = field(default_factory=dict)  # what its rows have, by column
    colour: int = 0
    is_printed: bool = False


@dataclass(frozen=True)
class Plot:
    """`x` is the column of a horizontal axis, of logarithms to the base `log_x` unless that is 0; without it there are bars, whose places
    are named by the columns `places`."""

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


_PART_WORDS = {"data_wait": "page wait", "other_wait": "other waits", "service_busy": "service while busy by others' requests",
               "service_idle": "lent to others' requests"}


def of_parts(name, title, places, parts=PARTS):
    """The parts of the nodes' time, one on the other."""
    series = [Series(_PART_WORDS.get(part, part.replace("_", " ")), part, colour=colour) for colour, part in enumerate(parts)]
    return Plot(name, title, "of the nodes' time (%)", tuple(series), places=places, is_stacked=True)


def check():
    """Raises a program.Error if there is no matplotlib."""
    if importlib.util.find_spec("matplotlib") is None:
        raise program.Error("--plots needs Python's module matplotlib: apt-get install python3-matplotlib")


def write(folder, name, table, plots):
    """The table as data, NAME.csv, and each plot of it as a picture."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{name}.csv").write_text(table.text("csv"))
    for plot in plots:
        (folder / f"{plot.name}.svg").write_text(draw(plot, table))


def points(plot, series, table):
    """Place and number of each row that the series has a number in; places are numbers of the axis, or texts."""
    found = []
    for row in table.rows:
        number = table.value(row, series.column)
        if number is not None and all(table.value(row, name) == value for name, value in series.where.items()):
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
        figure, axis = pyplot.subplots(figsize=(7.5 if plot.x else max(7.5, 0.15 * len(table.rows)), 4), layout="constrained")
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
            marker = _MARKS[series.colour % len(_MARKS)]
            axis.plot(*zip(*found), color=_colour(series), marker=marker, label=series.label, **style)
    axis.set_xlabel(plot.x_label or plot.x)
    if plot.log_x:
        axis.set_xscale("log", base=plot.log_x)
    if plot.log_x == 2:
        ticks = sorted({place for series in plot.series for place, _ in points(plot, series, table)})
        axis.set_xticks(ticks, map(str, ticks))


def _colour(series):
    return COLOURS[series.colour % len(COLOURS)]


def _bars(axis, plot, table):
    numbers = [(series, dict(points(plot, series, table))) for series in plot.series]
    places = list(dict.fromkeys(place for _, found in numbers for place in found))
    width, low = 0.8 if plot.is_stacked else 0.8 / len(numbers), [0.0] * len(places)
    for index, (series, found) in enumerate(numbers):
        heights = [found.get(place, 0.0) for place in places]
        offset = 0 if plot.is_stacked else (index - (len(numbers) - 1) / 2) * width
        axis.bar([at + offset for at in range(len(places))], heights, width, low if plot.is_stacked else 0.0,
                 color=_colour(series), label=series.label)
        low = [below + height for below, height in zip(low, heights)]
    is_narrow = len(places) > 6 or max((len(str(place)) for place in places), default=0) > 15
    axis.set_xticks(range(len(places)), places, rotation=45 if is_narrow else 0, ha="right" if is_narrow else "center")
