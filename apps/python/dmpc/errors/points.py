"""The settings that are measured: every knob of a render that trades time for error, turned alone about a base point."""

from dataclasses import dataclass, replace
from fractions import Fraction

KNOBS = ("samples", "adaptive", "cutoff", "depth", "tessellation", "arithmetic", "quality", "bounces", "emitters")
_ERRORS = ("64/255", "32/255", "16/255", "8/255", "4/255", "2/255", "1/255", "1/510", "1/1020", "1/2040")
_QUICK_ERRORS = 5  # the smallest
_CUTOFFS = ("1/64", "1/255", "1/512", "1/1024", "1/4096", "0")
_DEPTHS = (1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 16, 24, 32, 64, 128)
_BOUNCES = (0, 1, 2, 3, 4, 6, 8, 12, 16, 32, 64, 128)
_SAMPLES_MAX = ["--samples-max=4096"]  # of a mesh file, too


@dataclass(frozen=True)
class Setting:
    """`depth` and `cutoff` are not of paths, `bounces` and `emitters` of nothing else."""
    samples: int = 16  # a pixel, unless it is refined
    error: str = ""  # asked of adaptive sampling
    quality: str = ""  # which has samples, error and cutoff
    cutoff: str = "0"
    depth: int = 8
    tessellation: int = 0
    bounces: int | None = None
    emitters: int = 1024

    @property
    def is_refined(self):
        return bool(self.error or self.quality)

    @property
    def is_by_paths(self):
        return self.bounces is not None

    def words(self):
        """Those of dmpc render, but for the scene's."""
        asked = [f"--quality={self.quality}"] if self.quality else [f"--error={self.error}"]
        samples = ["--samples=auto", *_SAMPLES_MAX, *asked] if self.is_refined else [f"--samples={self.samples}"]
        cutoff = [] if self.quality else [f"--cutoff={self.cutoff}"]
        return [*samples, *([f"--bounces={self.bounces}"] if self.is_by_paths else [f"--depth={self.depth}", *cutoff])]


@dataclass(frozen=True)
class Point:
    """On a knob's curve. Several knobs may share a setting: the base point."""
    knob: str
    text: str  # its position, without commas
    setting: Setting


def value_of(text):
    """Of an error or a cutoff."""
    return float(Fraction(text))


@dataclass(frozen=True)
class Sweep:
    """`tessellations` are positions of that knob above exact quadrics, `emitters` how many the base point samples, `error_least` the least
    error asked of a refined picture. A quick sweep leaves out every other position, but never the last one."""
    base: Setting
    tessellations: tuple = ()
    emitters: int = 0
    is_quick: bool = False

    def points(self, knobs, error_least=0.0):
        """By knob, from the cheapest position of each to the base point's or beyond."""
        return [Point(knob, text, replace(self.base, **turned))
                for knob in KNOBS if knob in knobs for text, turned in self._positions(knob, error_least)]

    def _positions(self, knob, error_least):
        """Their texts, and what is changed in the base point."""
        if knob == "samples":
            counts = {1, 4, 16, 32, 64, self.base.samples} | ({256} if self.base.is_by_paths or not self.is_quick else set())
            return [(str(count), {"samples": count}) for count in sorted(counts)]
        if knob == "adaptive":
            errors = [error for error in _ERRORS if value_of(error) >= error_least]
            return [(error, {"error": error}) for error in (errors[-_QUICK_ERRORS:] if self.is_quick else errors)]
        if knob == "quality":
            return [(quality, {"quality": quality}) for quality in ("draft", "good")]
        if knob == "arithmetic":
            return [("float", {})]
        if knob == "tessellation":
            return [*((f"t{n}", {"tessellation": n}) for n in self.tessellations), *([("exact", {})] if self.tessellations else [])]
        if knob == "emitters":
            fewer = [4 ** n for n in range(20) if 4 ** n < self.emitters and not self.is_quick]
            counted = [("none", {"emitters": 0}), *((str(n), {"emitters": n}) for n in fewer), (str(self.emitters), {})]
            return counted if self.emitters else []
        last = getattr(self.base, knob)
        all_of = _CUTOFFS if knob == "cutoff" else [*(n for n in (_DEPTHS if knob == "depth" else _BOUNCES) if n < last), last]
        return [(str(position), {knob: position}) for position in (all_of[::-1][::2][::-1] if self.is_quick else all_of)]
