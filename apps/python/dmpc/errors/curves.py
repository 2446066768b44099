"""Errors with their intervals, and curves of errors over costs."""

import math

from .pictures import GROUPS

REACH = 1.1  # errors so far beyond a curve, as a factor, still have a cost, by its straight continuation


def error_of(squares, left_out=None):
    """The root of the groups' sum, 0 for a sum below 0; without one group, if it is named."""
    total = sum(squares)
    if left_out is not None:
        total = (total - squares[left_out]) * GROUPS / (GROUPS - 1)
    return math.sqrt(max(total, 0.0))


def interval(squares):
    """Low, middle and high of an error above 0, in proportion of 95 % of the groups' sum: two standard deviations, by how much they
    differ."""
    error = error_of(squares)
    mean = error * error / GROUPS
    variance = sum((square - mean) * (square - mean) * GROUPS / (GROUPS - 1) for square in squares)
    factor = math.exp(math.sqrt(variance) / (error * error))  # twice the deviation, and half of that for the root
    return error / factor, error, error * factor


def pareto_front(points, drawn):
    """Which (cost, error) no other beats, by a smaller error at no more cost, or the same error at less; all of several equal ones. Those
    that are not drawn are not on it, and beat none."""
    def beats(one, other):
        return one[0] <= other[0] and one[1] <= other[1] and one != other

    shown = [point for point, is_drawn in zip(points, drawn) if is_drawn]
    return [is_drawn and not any(beats(other, point) for other in shown) for point, is_drawn in zip(points, drawn)]


def cost_at(points, error):
    """The cost at which a curve through (cost, error), in any order, reaches the error: linear in the logarithms of both between two
    neighbours by error. None beyond REACH, and beyond a single point. Points without cost or error are left out; of several with one error
    the cheapest counts."""
    costs = {}
    for cost, at in points:
        if cost > 0 and at > 0:
            costs[at] = min(cost, costs.get(at, cost))
    if error in costs:
        return costs[error]
    errors = sorted(costs)
    if len(errors) < 2 or error * REACH < errors[0] or error > errors[-1] * REACH:
        return None
    above = min(max(sum(each < error for each in errors), 1), len(errors) - 1)
    low, high = errors[above - 1], errors[above]
    return costs[low] * (costs[high] / costs[low]) ** (math.log(error / low) / math.log(high / low))
