"""A study of one's own: what a picture costs as its scene, or the number of nodes, grows.

    python3 scale.py tetra-5 tetra-6 tetra-7 tetra-8

Below the rows stand the exponents e of y ~ x^e, x being primitives: the slope of log y over log x by least squares. Times are of this
computer's clock, by phase, so nothing else should run beside it.
"""

import sys

import numpy
import pandas

import dmpc

FIGURES = ["database.primitives", "seconds.load", "seconds.build", "seconds.prepare", "seconds.render", "database.bytes", "pages.faults", "rays.total"]


def growth(x, y):
    """The exponent e of y ~ x^e; nothing where y has no two values above 0."""
    x, y = numpy.asarray(x, float), numpy.asarray(y, float)
    known = (x > 0) & (y > 0)
    return numpy.polyfit(numpy.log(x[known]), numpy.log(y[known]), 1)[0] if len(set(x[known])) > 1 else None


def scale(scenes, nodes=(8,), **options):
    """A frame with a row for each scene and number of nodes, whose attrs["growth"] has the exponents over scenes."""
    parts = {scene: dmpc.sweep(scene, nodes=list(nodes), columns=FIGURES, **options) for scene in scenes}
    table = pandas.concat(parts, names=["scene"]).reset_index("scene").reset_index(drop=True)
    table["faults a ray"] = table.pop("pages.faults") / table.pop("rays.total")
    figures = [name for name in table if name.startswith("seconds.")] + ["database.bytes"]
    table.attrs["growth"] = {name: growth(table["database.primitives"], table[name]) for name in figures}
    return table


if __name__ == "__main__":
    found = scale(sys.argv[1:])
    print(found.to_string(index=False))
    print("growth:", ", ".join(f"{name} {exponent:.2f}" for name, exponent in found.attrs["growth"].items() if exponent is not None))
