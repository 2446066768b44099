"""The table "described": every system as it was when it was described, and the verdicts that its authors drew."""

from . import rows, setups, verdicts

_CLAIMS = (("subsampled", "equal-size", "regions by a small picture are faster than regions of equal size"),
           ("svm", "subsampled", "pages that travel are faster than rays that travel"),
           ("replicated", "replicated-extents", "a subdivision of space takes less time than a tree of extents"))


def add_to(table, subject, names, nodes):
    made = []
    for name in names:
        setup = setups.described(setups.systems()[name], nodes)
        made.append(setups.with_whole_cache(setup, subject.database(setup.database)["pages"]))
    results = subject.get([subject.line(setup) for setup in made])
    for setup, result in zip(made, results):
        table.add(rows.row_of(subject, "described", "as needed", setup, result))
    found = {setup.system.name: rows.compared(subject, setup, result) for setup, result in zip(made, results) if "seconds" in result}
    for first, second, text in _CLAIMS:
        if first in found and second in found:
            table.note(f"Badouel, Bouatouch and Priol (1994): {text}: {_judged(found[first], found[second])}")


def _judged(first, second):
    """The authors compared one strategy, with all that belongs to it, with another: what only one of two has is left out."""
    if first.options["strategy"] != second.options["strategy"]:
        shared = first.options.keys() & second.options.keys()
        for row in (first, second):
            row.options = {name: value for name, value in row.options.items() if name in shared}
    if not verdicts.may_isolate(first, second):
        return "not judged, since the structures have prices of their own."
    return f"{verdicts.outcome(first, second)}. {verdicts.isolated(first, second)}"
