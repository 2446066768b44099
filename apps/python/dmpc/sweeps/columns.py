"""What a sweep's table tells of its runs, and the plots of that."""

import itertools
import math

from .. import program
from ..studies.plots import SERIES_MAX, Plot, Series
from ..studies.table import Column
from . import figures

_DIGITS = 4  # of a column's largest number


def names(options, variations, known):
    """Of the figures asked for, or else of the usual ones. Raises a program.UsageError for one that is none, or there twice."""
    if options.columns is None:
        return options.usual.split(",")
    found = []
    for typed in options.columns.split(","):
        name = figures.figure_meant(typed, known)
        if name in found:
            raise program.UsageError(f"--columns={options.columns}: {name} is there twice")
        if name in [variation.name for variation in variations]:
            raise program.UsageError(f"--columns={name}: it varies, and so has a column of its own")
        found.append(name)
    return found


def of(variations, most):
    """`most` has the largest magnitude in each column of a figure, 0 if it has no fractions."""
    return [*(Column(variation.name, variation.unit) for variation in variations),
            *(Column(name, figures.unit(name), _digits(value)) for name, value in most.items())]


def _digits(most):
    return min(max(_DIGITS - 1 - math.floor(math.log10(most)), 0), 9) if most else 0


def plots(scene, variations, numbers):
    """One for each figure: over the first variation by numbers, with a curve for each combination of the rest, or bars; none for more
    curves than can be told apart."""
    along = next((each for each in variations if each.are_numbers and len(each.cells) > 1), None)
    rest = [each for each in variations if each is not along and len(each.cells) > 1]
    curves = list(itertools.product(*(zip(each.values, each.cells) for each in rest))) if along else [()]
    for name in numbers if len(curves) <= SERIES_MAX else ():
        series = [Series(", ".join(f"{each.name} {value}" for each, (value, _) in zip(rest, curve)) or name, name,
                         {each.name: cell for each, (_, cell) in zip(rest, curve)}, colour) for colour, curve in enumerate(curves)]
        yield Plot(name.replace(".", "-"), f"{name} of {scene}", Column(name, figures.unit(name)).header, tuple(series),
                   along.name if along else "", Column(along.name, along.unit).header if along else "",
                   2 if along and _grows(along.cells) else 0, places=tuple(each.name for each in variations))


def _grows(cells):
    return 0 < min(cells) <= max(cells) / 8
