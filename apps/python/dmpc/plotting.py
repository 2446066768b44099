"""Plots by matplotlib, of the data in which dmpc writes them (apps/frontend/table/plot_data.h) and studies in Python make them."""

import io
import json
import pathlib

import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot

_INK = "#010203"  # stands for the colour of text and axes
# M. Okabe and K. Ito, "Color Universal Design", 2008, with a brown in place of their yellow; then the first again, dashed or hatched.
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#606060", "#8c6d46")
_MARKS = "os^Dv"


def main(words):
    """Draws NAME.svg from NAME.json: the words are a folder and names."""
    folder = pathlib.Path(words[0])
    for name in words[1:]:
        (folder / f"{name}.svg").write_text(drawn(json.loads((folder / f"{name}.json").read_text()), name))


def drawn(data, name, is_in_page=False):
    """The plot as SVG, the same for the same data and name: black on white, or in the colours of the page around it."""
    inked = dict.fromkeys(("text.color", "axes.edgecolor", "axes.labelcolor", "xtick.color", "ytick.color"), _INK)
    with pyplot.rc_context({**inked, "font.size": 9, "svg.fonttype": "none", "svg.hashsalt": name, "hatch.linewidth": 1.5}):
        figure, axis = pyplot.subplots(figsize=(max(7.5, 0.15 * len(data.get("places", ()))), 4), layout="constrained")
        for index, series in enumerate(data["series"]):
            _DRAWERS[series["mark"]](axis, data, index, series)
        for letter in "xy":
            _set_axis(axis, letter, data[letter])
        if places := data.get("places"):
            slanted = {"rotation": 45, "ha": "right"} if len(places) > 6 or max(map(len, places)) > 15 else {}
            axis.set_xticks(range(len(places)), places, **slanted)
        axis.set_title(data["title"])
        axis.spines[["top", "right"]].set_visible(False)
        if len(data["series"]) > 1:
            figure.legend(loc="upper center", bbox_to_anchor=(0.5, 0), ncol=3, frameon=False)
        text = io.StringIO()
        figure.savefig(text, format="svg", transparent=is_in_page, bbox_inches="tight", metadata={"Date": None})
        pyplot.close(figure)
    svg = text.getvalue()
    return svg[svg.index("<svg"):].replace(_INK, "currentColor") if is_in_page else svg.replace(_INK, "#000000")


def _set_axis(axes, letter, data):
    """Limits and ticks that there are none of are matplotlib's own."""
    axes.set(**{f"{letter}label": data["label"], f"{letter}scale": "log" if data.get("log") else "linear"})
    if "least" in data:
        axes.set(**{f"{letter}lim": (data["least"], data.get("most"))})
    if ticks := data.get("ticks"):
        axis = getattr(axes, f"{letter}axis")
        axis.set_ticks([place for place, _ in ticks], [text for _, text in ticks])
        axis.set_ticks([], minor=True)


def _look(series):
    """Of lines: again dashed."""
    number = series["color"]
    return {"color": COLOURS[number % len(COLOURS)], "label": series["name"], "marker": _MARKS[number % len(_MARKS)],
            "linestyle": "--" if number >= len(COLOURS) else "-"}


def _line(axis, data, index, series):
    axis.plot(*_columns(sorted(series["rows"]))[:2], linewidth=1.2, markersize=3, clip_on=False, **_look(series))


def _points(axis, data, index, series):
    axis.plot(*_columns(series["rows"])[:2], markerfacecolor="none", clip_on=False, **{**_look(series), "linestyle": ""})


def _intervals(axis, data, index, series):
    place, number, low, high = _columns(sorted(series["rows"]))
    ends = [[at - end for at, end in zip(number, low)], [end - at for at, end in zip(number, high)]]
    axis.errorbar(place, number, ends, linewidth=1.2, markersize=3, clip_on=False, **_look(series))


def _bars(axis, data, index, series):
    """Above those before it, or beside them: `below` has the sums so far by place."""
    count, below = len(data["series"]), data.setdefault("below", {})
    places, heights = _columns(series["rows"])
    width = data["width"] or (0.8 if data["stacked"] else 0.8 / count)
    shift = data["width"] / 2 if data["width"] else 0 if data["stacked"] else (index - (count - 1) / 2) * width
    bottoms = [below.get(at, 0.0) if data["stacked"] else 0.0 for at in places]
    below.update((at, bottom + height) for at, bottom, height in zip(places, bottoms, heights))
    number = series["color"]
    axis.bar([at + shift for at in places], heights, width, bottoms, color=COLOURS[number % len(COLOURS)], label=series["name"],
             hatch="//" if number >= len(COLOURS) else None, edgecolor="white" if number >= len(COLOURS) else None)


def _columns(rows):
    return [list(column) for column in zip(*rows)]


_DRAWERS = {"line": _line, "points": _points, "intervals": _intervals, "bars": _bars}
