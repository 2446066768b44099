"""The results as a table, and plots of it."""

import math

from ..studies.plots import Plot, Series
from ..studies.table import WIDTH, Column, Table
from ..studies.texts import folded
from . import curves, findings

_STEPS = 255  # errors are in 8-bit steps of linear light
_MEASURES = (("RMSE", "1/255", 3, "root_mean_square"), ("relative MSE", "", 6, "relative_mean_square"), ("largest", "1/255", 1, "largest"),
             ("99th percentile", "1/255", 2, "percentile_99"), ("FLIP mean", "", 4, "flip_mean"),
             ("FLIP 99th percentile", "", 3, "flip_percentile_99"))
_FRONTS = ("front", "front of uniform and adaptive")
_COLUMNS = (Column("scene"), Column("knob"), Column("setting"), Column("samples a pixel", digits=2), Column("rays"),
            Column("rays a pixel", digits=2), Column("seconds least", "s", 3), Column("seconds most", "s", 3), Column("error", "1/255", 3),
            Column("error low", "1/255", 3), Column("error high", "1/255", 3), Column("remark"), *map(Column, _FRONTS))
_SAMPLING = ("samples", "adaptive")
_COLOURS = {"samples": 0, "adaptive": 1, "cutoff": 2, "depth": 3, "tessellation": 4, "quality": 5, "bounces": 2, "emitters": 4}
_TITLES = {"samples": "uniform sampling", "adaptive": "adaptive sampling"}


class ErrorTable(Table):
    """People read a summary first. No error of a picture by paths is due to one knob alone."""

    def __init__(self, title, are_by_paths, shown=lambda text: None):
        self._are_by_paths, self.summary = are_by_paths, ""
        measures = [Column(kind + name, unit, digits) for kind in ("", "deterministic ")[:2 - are_by_paths]
                    for name, unit, digits, _ in _MEASURES]
        super().__init__(title, (*_COLUMNS, *measures), shown)

    def add_results(self, result):
        """The rows of all points that are measured, in their order."""
        fronts = list(_fronts(result))
        for point in result.points:
            if result.of(point).seconds:
                self.add(self._row(result, point, ["yes" if point.setting in front else "" for front in fronts]))

    def add_first(self, result, measurement):
        """The rows of a measurement, before it is known which others beat it."""
        for point in result.points:
            if point.setting == measurement.setting:
                self.add(self._row(result, point, ["", ""]))

    def _row(self, result, point, fronts):
        one, pixels = result.of(point), result.reference.pixels
        is_told = result.is_told(one)
        low, middle, high = [_STEPS * end for end in curves.interval(one.squares)] if is_told else [None] * 3
        return [result.scene, point.knob, point.text, one.samples / pixels, one.rays, one.rays / pixels, one.least, max(one.seconds),
                middle, low, high, "" if is_told else "less than the reference's own error", *fronts, *_measures(one.error),
                *([] if self._are_by_paths else _measures(result.deterministic(point)))]

    def text(self, form):
        summary = folded(self.summary, WIDTH, "") + "\n\n" if self.summary and form == "markdown" else ""
        return summary + super().text(form)


def _measures(error):
    """Empty for infinity, which a table cannot hold."""
    values = [(_STEPS if unit else 1) * error[key] if error else math.inf for _, unit, _, key in _MEASURES]
    return [value if math.isfinite(value) else None for value in values]


def _fronts(result):
    """The settings that no other beats: among all, and among those of uniform and adaptive sampling."""
    done = result.done()
    sampling = {point.setting for point in result.points if point.knob in _SAMPLING}
    points = [(one.least, curves.error_of(one.squares)) for one in done]
    for settings in (result.measurements, sampling):
        front = curves.pareto_front(points, [result.is_told(one) and one.setting in settings for one in done])
        yield {one.setting for one, is_on in zip(done, front) if is_on}


def plots_of(result, name):
    """Errors over processor time: of uniform and adaptive sampling alone, and of the other knobs, if there are any. Points that nothing
    beats in the same plot are marked."""
    def plot(name, title, series, front):
        on_front = Series("on the front", "error", {front: "yes"}, 6, is_printed=True)
        size = f"{result.reference.width}x{result.reference.height}"
        return Plot(name, f"{result.scene}: {title}", "error without the reference's own (RMSE, 1/255)", (*series, on_front),
                    "seconds least", f"processor time of {size} pixels (s, least of the rounds)", 10, is_log=True)

    def series(knob, **more):
        return Series(_TITLES.get(knob, knob), "error", {"knob": knob}, _COLOURS[knob], knob == "quality", **more)

    ends = {"low": "error low", "high": "error high"}
    title = findings.shares_text(findings.adaptive_shares(result)[-1:]) or "error against time"
    plots = [plot(name, title, [series(knob, **ends) for knob in _SAMPLING], _FRONTS[1])]
    if any(point.knob not in (*_SAMPLING, "arithmetic") for point in result.points):
        plots.append(plot(name + "_knobs", "the other knobs", [series(knob) for knob in _COLOURS], _FRONTS[0]))
    return plots
