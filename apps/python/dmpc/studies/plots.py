"""Plots of tables, by matplotlib, which is asked for when a plot is wanted."""

import importlib.util

from .. import program


def check():
    """Raises a program.Error if there is no matplotlib."""
    if importlib.util.find_spec("matplotlib") is None:
        raise program.Error("--plots needs Python's module matplotlib: apt-get install python3-matplotlib")


def bars(path, title, label, series):
    """Draws values above 0 on a logarithmic scale: `series` has dictionaries by name, each of values by place."""
    import matplotlib
    matplotlib.use("svg")
    from matplotlib import pyplot

    places = list(dict.fromkeys(place for values in series.values() for place in values))
    width = 0.8 / max(len(series), 1)
    with pyplot.rc_context({"svg.hashsalt": "dmpc", "font.size": 9}):
        figure, axis = pyplot.subplots(figsize=(2 + 0.3 * len(places) * len(series), 5), layout="constrained")
        for number, (name, values) in enumerate(series.items()):
            at = [place + width * (number - (len(series) - 1) / 2) for place in range(len(places))]
            axis.bar(at, [values.get(place, float("nan")) for place in places], width, label=name)
        axis.set_yscale("log")
        axis.set_ylabel(label)
        axis.set_title(title)
        axis.set_xticks(range(len(places)), places, rotation=90)
        axis.legend()
        figure.savefig(path, metadata={"Date": None})
        pyplot.close(figure)
