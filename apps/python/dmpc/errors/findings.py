"""The results in sentences."""

import math
from dataclasses import dataclass
from operator import attrgetter

from ..studies.texts import counted
from . import curves
from .pictures import GROUPS
from .points import value_of

_GOOD = 0.25 / 255  # a deterministic error below which nobody sees it
_seconds, _rays = attrgetter("least"), attrgetter("rays")  # costs


@dataclass(frozen=True)
class AdaptiveShare:
    """The processor time of adaptive sampling over that of uniform sampling at an equal error that adaptive sampling was asked for; the
    interval has the noise of pixels, and of times the rounds' least and most."""
    error: str
    low: float
    middle: float
    high: float
    rays: float

    @property
    def is_undecided(self):
        return self.low <= 1 <= self.high


def _curve(result, knob, cost, left_out=None):
    """(cost, error) of one knob; without a group of pixels, if it is named."""
    measured = [result.of(point) for point in result.points if point.knob == knob]
    return [(cost(one), curves.error_of(one.squares, left_out)) for one in measured if result.is_told(one)]


def _share(result, error, cost, left_out=None):
    uniform, adaptive = (curves.cost_at(_curve(result, knob, cost, left_out), error) for knob in ("samples", "adaptive"))
    return None if uniform is None or adaptive is None else adaptive / uniform


def adaptive_shares(result):
    """At all such errors that both curves reach, from the largest on. The noise of pixels follows from leaving out one group of them after
    the other (the jackknife)."""
    shares = []
    for point in result.points:
        error = value_of(point.setting.error) if point.knob == "adaptive" else 0
        middle = _share(result, error, _seconds) if error else None
        if middle is None:
            continue

        def distance(cost, left_out=None):
            return abs(math.log((_share(result, error, cost, left_out) or middle) / middle))

        variance = sum(distance(_seconds, group) ** 2 for group in range(GROUPS)) * (GROUPS - 1) / GROUPS
        spread = max(distance(lambda one: one.seconds[min(turn, len(one.seconds) - 1)]) for turn in range(len(result.done()[0].seconds)))
        factor = math.exp(math.hypot(2 * math.sqrt(variance), spread))
        shares.append(AdaptiveShare(point.text, middle / factor, middle, middle * factor, _share(result, error, _rays) or 0))
    return shares


def shares_text(shares):
    """adaptive takes 0.83 of uniform's time at 1/255 (0.79 to 0.88); undecided ones are told as no difference."""
    places = [f"at {share.error} ({share.low:.2f} to {share.high:.2f})" for share in shares]
    decided = ", ".join(f"{share.middle:.2f} {place}" for share, place in zip(shares, places) if not share.is_undecided)
    undecided = ", ".join(place.removeprefix("at ") for share, place in zip(shares, places) if share.is_undecided)
    sentences = ["adaptive takes " + decided.replace(" at", " of uniform's time at", 1)] if decided else []
    if undecided:
        sentences.append(("" if decided else "between adaptive and uniform ") + "no difference that this run can tell at " + undecided)
    return "; ".join(sentences)


def _adaptive_text(result):
    shares = adaptive_shares(result)
    if shares:
        return f"{result.scene}: {shares_text(shares)}; in rays " + ", ".join(f"{one.rays:.2f} at {one.error}" for one in shares) + "."
    has_both = {"samples", "adaptive"} <= {point.knob for point in result.points}
    return f"{result.scene}: no error asked of adaptive sampling is reached by both it and uniform sampling." if has_both else ""


def cheapest_point(result, knob):
    """The one with the fewest rays and a good deterministic error, or None."""
    good = [point for point in result.points if point.knob == knob and (error := result.of(point).deterministic)
            and error["root_mean_square"] < _GOOD]
    return min(good, key=lambda point: result.of(point).rays, default=None)


def _cheapest_text(result):
    found = []
    for knob in ("cutoff", "depth"):
        if point := cheapest_point(result, knob):
            one, exact = result.of(point), result.measurements[result.base]
            found.append(f"{knob} {point.text} ({255 * one.deterministic['root_mean_square']:.3f}/255, "
                         f"{one.rays / max(exact.rays, 1):.3f} times the rays)")
    return f"{result.scene}: cheapest with a deterministic RMSE below a quarter of an 8-bit step: {', '.join(found)}." if found else ""


def _measured(result, knob, position):
    return next((result.of(point) for point in result.points
                 if (point.knob, point.text) == (knob, position) and result.of(point).seconds), None)


def _error_text(result, measurement):
    below = "" if result.is_told(measurement) else " (below the reference's own error)"
    return f"{255 * curves.error_of(measurement.squares):.2f}/255{below}"


def _quality_text(result):
    draft, good = (_measured(result, "quality", position) for position in ("draft", "good"))
    if draft is None or good is None:
        return ""
    return (f"{result.scene}: good quality has an error of {_error_text(result, good)}, draft {_error_text(result, draft)} for "
            f"{draft.rays / max(good.rays, 1):.3f} times the rays ({draft.least / good.least:.3f} times the seconds).")


def _chance_text(result):
    """What light found by chance takes beside uniform samples of the same error: at least, if one sample has less."""
    if not result.base.is_by_paths:
        return ""
    turned, even, text = _measured(result, "emitters", "none"), _curve(result, "samples", _seconds), ""
    if turned and result.is_told(turned) and even:
        error = curves.error_of(turned.squares)
        cost, worst = curves.cost_at(even, error), max(even, key=lambda point: point[1])
        is_beyond = cost is None and error > worst[1] and worst[0] > 0
        if cost is not None or is_beyond:
            text = (f"{result.scene}: BSDF sampling alone takes {'at least ' if is_beyond else ''}"
                    f"{turned.least / (worst[0] if is_beyond else cost):.2f} times the time for the same RMSE.")
    none = f"{result.scene}: there is no emitter for light sampling; --light-radius turns lights into spheres."
    return text if result.reference.emitters else f"{text} {none}".strip()


def _reference_text(result):
    """It, and where it ends the range of errors."""
    reference, n = result.reference, result.reference.samples_a_side
    below = sum(not result.is_told(one) for one in result.done())
    light = counted(result.base.bounces, "bounce") if result.base.is_by_paths else f"depth {result.base.depth}"
    rest = (f": of {counted(below, 'setting')} below it nothing is drawn or compared; a larger --reference-samples reaches further."
            if below else ".")
    return (f"{result.scene}: the reference has {n}x{n} samples a pixel, {light}, {reference.rays:,} rays in "
            f"{reference.seconds:.{3 if reference.seconds < 10 else 1}f} s; errors end at its own one, {255 * reference.own_error:.3f}/255 "
            f"(relative MSE {reference.own_relative:.3g}){rest}")


def findings_of(result):
    texts = (_adaptive_text, _reference_text, _cheapest_text, _quality_text, _chance_text)
    return [sentence for text in texts if (sentence := text(result))]


def summary_of(results):
    """What adaptive sampling takes, and where the range of errors ends, of each scene that has a measurement."""
    return " ".join(text for one in results if one.done() for text in (_adaptive_text(one), _reference_text(one)) if text)
