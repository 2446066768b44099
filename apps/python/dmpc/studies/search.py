"""The search for a system's options, a coordinate descent: one option after the other, each value with the best so far of all others; one
round."""

from dataclasses import dataclass

from .runs import seconds_of
from .texts import time_text


@dataclass(frozen=True)
class Searched:
    """An option and its values, the one first with which the search begins."""
    name: str
    values: tuple


@dataclass
class Found:
    """The best setting, values by option, with its result, which has no seconds if there was no room for any."""
    setting: dict
    result: dict
    steps: list  # texts of what was tried, and results

    @property
    def seconds(self):
        return seconds_of(self.result)

    def steps_text(self):
        """defaults 3.10 ms, page-size 4KiB 2.00 ms, in-flight 1 no room."""
        return ", ".join(f"{tried} {time_text(result['seconds']) if 'seconds' in result else 'no room'}" for tried, result in self.steps)


def descend(options, line_of):
    """Generator for in_step(), which returns a Found: yields lists of command lines, which line_of() makes of settings, and is sent their
    results. A new value must be faster."""
    setting = {option.name: option.values[0] for option in options}
    [result] = yield [line_of(setting)]
    found = Found(setting, result, [("defaults", result)])
    for option in options:
        trials = [{**found.setting, option.name: value} for value in option.values[1:]]
        results = yield [line_of(trial) for trial in trials]
        for trial, result in zip(trials, results):
            found.steps.append((f"{option.name} {trial[option.name]}", result))
            if seconds_of(result) < found.seconds:
                found.setting, found.result = trial, result
    return found


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
