"""What may be concluded from two runs: nothing else of the study concludes anything."""

from dataclasses import dataclass

from .. import program
from ..studies import judging
from ..studies.texts import bytes_text, counted, time_text

BEST = "Best against best"


@dataclass
class Row:
    """A run as verdicts see it. `circumstances` are what two runs must share: scene, machine, film, nodes,
    and memory, None for what each system needs."""
    name: str
    circumstances: tuple
    options: dict  # texts by name
    seconds: float
    search: str = ""  # by which the options were found; empty: they were given


def differences(first, second):
    """The options in which two rows differ, with both values, None for a row that does not have it."""
    names = sorted({**first.options, **second.options})
    return [(name, first.options.get(name), second.options.get(name)) for name in names
            if first.options.get(name) != second.options.get(name)]


def may_isolate(first, second):
    """Whether they differ in one option alone."""
    return first.circumstances == second.circumstances and len(differences(first, second)) == 1


def isolated(first, second):
    """Isolated, homes (spread, host) alone, 64 nodes of hdr, ..."""
    _expect(may_isolate(first, second), "an isolated verdict is about runs that differ in one option")
    [difference] = differences(first, second)
    return f"Isolated, {_difference(*difference)} alone, {_times(first, second)}."


def best(first, second, ahead=None):
    """Of two rows that are each the best of the same search; `ahead`: in how many draws the first stayed ahead, and of how many."""
    _expect(first.circumstances == second.circumstances, "the best are compared in the same circumstances")
    _expect(first.search == second.search != "", "the best are compared if the same search has found them")
    text = f"{BEST}, undecided, " if is_undecided(ahead) else f"{BEST}, "
    text += _times(first, second) + (f"; ahead in {ahead[0]} of {ahead[1]} draws of the prices" if ahead else "")
    both = [_difference(*each) for each in differences(first, second) if None not in each]
    return f"{text}. They differ in {', '.join(both)}{_alone(first, second)}{_alone(second, first)}."


def is_undecided(ahead):
    return ahead is not None and ahead[0] < judging.DECIDED * ahead[1]


def outcome(first, second):
    """Of an author's claim that the first takes less time."""
    return "a tie" if judging.is_tie(first.seconds, second.seconds) else "held" if first.seconds < second.seconds else "not held"


def _expect(is_so, what):
    if not is_so:
        raise program.InternalError(f"this is a bug in dmpc, please report it: {what}")


def _difference(name, first, second):
    return f"{name} ({first or 'none'}, {second or 'none'})"


def _alone(row, other):
    """; svm on extents alone has homes spread, in-flight 64."""
    own = [f"{name} {value}" for name, value in sorted(row.options.items()) if name not in other.options]
    return f"; {row.name} alone has {', '.join(own)}" if own else ""


def _times(first, second):
    _, machine, _, nodes, memory = first.circumstances
    room = f"{bytes_text(memory)} each" if memory is not None else "as much memory as each needs"
    end = "a tie" if judging.is_tie(first.seconds, second.seconds) else f"{second.seconds / first.seconds:.2f} times as long"
    return (f"{counted(nodes, 'node')} of {machine}, {room}: {first.name} {time_text(first.seconds)}, {second.name} "
            f"{time_text(second.seconds)}, {end}")


def first_in(draws):
    """In how many draws each row is the fastest, by more than a tie; `draws` has the seconds of each row."""
    rows = range(len(draws[0]) if draws else 0)
    return [sum(all(judging.is_faster(draw[row], draw[other]) for other in rows if other != row) for draw in draws) for row in rows]


def ahead_in(draws, row, other):
    """In how many draws `row` is faster than `other`, by more than a tie, and of how many."""
    return sum(judging.is_faster(draw[row], draw[other]) for draw in draws), len(draws)
