"""Plots of tables: given values as marks without a line, found ones as lines or bars."""

import importlib.util
from dataclasses import dataclass, field

from .. import program
from .runs import PARTS

SERIES_MAX = 16  # that look unlike in one plot


@dataclass(frozen=True)
class Series:
    label: str
    column: str  # of its numbers
    where: dict = field(default_factory=dict)  # what its rows have, by column
    colour: int = 0
    is_printed: bool = False
    low: str = ""  # and high: of intervals, the columns of their ends
    high: str = ""


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


_PART_WORDS = {"data_wait": "page wait", "other_wait": "other waits", "service_busy": "service while busy",
               "service_idle": "service while idle"}


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
    """Place, number and ends of each row that the series has a number in; places are numbers of the axis, or texts."""
    found = []
    for row in table.rows:
        number = table.value(row, series.column)
        if number is not None and all(table.value(row, name) == value for name, value in series.where.items()):
            place = table.value(row, plot.x) if plot.x else " ".join(str(table.value(row, name)) for name in plot.places)
            found.append((place, number, *(table.value(row, end) for end in (series.low, series.high) if end)))
    return found


def data(plot, table):
    """What plotting.drawn() takes, of numbers from 0 on: series without a row are left out."""
    found = [(series, rows) for series in plot.series if (rows := points(plot, series, table))]
    places = list(dict.fromkeys(place for _, rows in found for place, *_ in rows))
    ticks = [[place, str(place)] for place in sorted(places)] if plot.x and plot.log_x == 2 else []
    mark = {True: "points", False: "line"} if plot.x else {False: "bars"}
    return {"title": plot.title, "stacked": plot.is_stacked, "width": 0, "places": [] if plot.x else list(map(str, places)),
            "x": {"label": (plot.x_label or plot.x), "log": bool(plot.x and plot.log_x), "ticks": ticks},
            "y": {"label": plot.y, "log": plot.is_log, "ticks": [], **({} if plot.is_log else {"least": 0})},
            "series": [{"name": series.label, "color": series.colour, "mark": "intervals" if series.low else mark[series.is_printed],
                        "rows": [(place if plot.x else places.index(place), *numbers) for place, *numbers in rows]}
                       for series, rows in found]}


def draw(plot, table, is_in_page=False):
    """As SVG, as plotting.drawn() has it. Raises ModuleNotFoundError without matplotlib."""
    from .. import plotting

    return plotting.drawn(data(plot, table), plot.name, is_in_page)
