"""The search for a system's options: a coordinate descent, one option after the other, as dmpc study systems has it."""

from . import design, runs


def descend(cell, scene, memory, name):
    """Yields lists of command lines and is sent their results; returns the seconds and the best setting."""
    system = design.SYSTEMS[name]
    options = [design.Searched(each.name, tuple(value for value in each.values if _is_priced(cell.machine, each.name, value)))
               for each in system.searched]
    best = {each.name: each.values[0] for each in options}
    if system.family == "questions":
        best["structure"] = "extents"
    [first] = yield [runs.line_of(cell, scene, memory, name, best.items())]
    seconds = runs.seconds_of(first)
    for option in options:
        trials = [{**best, option.name: value} for value in option.values[1:]]
        results = yield [runs.line_of(cell, scene, memory, name, trial.items()) for trial in trials]
        for trial, result in zip(trials, results):
            if runs.seconds_of(result) < seconds:
                seconds, best = runs.seconds_of(result), trial
    return seconds, tuple(best.items())


def _is_priced(machine, option, value):
    return option != "structure" or value != "voxels" or (machine, value) in design.PRICED


def in_step(kept, generators):
    """Runs all of them at once, step by step, so that what they ask for is run side by side; what they return, in their order."""
    results, asked = [None] * len(generators), {}
    for index, each in enumerate(generators):
        _advance(asked, results, generators, index, None)
    while asked:
        answers = kept.get([line for lines in asked.values() for line in lines])
        position, turn = 0, list(asked.items())
        asked.clear()
        for index, lines in turn:
            part = answers[position:position + len(lines)]
            position += len(lines)
            _advance(asked, results, generators, index, part)
    return results


def _advance(asked, results, generators, index, answer):
    try:
        asked[index] = generators[index].send(answer)
    except StopIteration as end:
        results[index] = end.value
