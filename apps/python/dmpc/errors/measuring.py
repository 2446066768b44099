"""The renders of one scene: every setting once a round, and its picture against the scene's reference."""

import json
import math
import pathlib
import shutil
from dataclasses import dataclass, field

from .. import program
from . import curves, pictures
from .points import Setting, Sweep

_OF_RUNS = ("--strategy", "--nodes")  # which dmpc build does not take
_OF_FOREST = ["--structure=extents", "--page-size=4KiB"]  # as dmpc render has it by default


@dataclass
class Measurement:
    """Of one setting. `seconds` are those of processor time in the phase `render`, by round: without one nothing is measured yet. `error`
    is against the reference, whose own error is a part of it; `deterministic`, if there is one, against the base point's picture, if that
    has the same samples."""
    setting: Setting
    seconds: list = field(default_factory=list)
    rays: int = 0
    samples: int = 0  # of all pixels
    film: str = ""
    error: dict = None
    squares: list = None
    deterministic: dict = None

    @property
    def least(self):
        """Other processes can only add to it."""
        return min(self.seconds)


class Reference:
    """What dmpc has made of a scene and told: figures by name, and files of pictures (apps/lab/bench/error/command.cpp)."""

    def __init__(self, figures, samples_a_side):
        told = dict(figure.split("=") for figure in figures.split(" "))
        self.samples_a_side = samples_a_side
        self.width, self.height, self.rays, self.emitters = (int(told[name]) for name in ("width", "height", "rays", "emitters"))
        self.pixels = self.width * self.height
        self.seconds, self.own_error, self.own_relative = (float(told[name]) for name in ("seconds", "own_error", "own_relative"))
        self.tessellations = tuple(map(int, filter(None, told["tessellations"].split(","))))
        self.files = told["pictures"].split(",")  # it, half the difference of its halves, and the base point in double precision


class Result:
    """Of one scene: `points`, and the `measurements` of their settings by setting, in the order in which they are made."""

    def __init__(self, scene, reference, base):
        self.scene, self.reference, self.base = scene, reference, base
        self.points, self.measurements, self.arithmetic = [], {}, None

    def of(self, point):
        return self.measurements[point.setting]

    def deterministic(self, point):
        """The error of the point's knob alone, if it has one."""
        own = self.of(point).deterministic if point.knob in ("cutoff", "depth", "tessellation") else None
        return self.arithmetic if point.knob == "arithmetic" else own

    def done(self):
        return [one for one in self.measurements.values() if one.seconds]

    def is_told(self, measurement):
        """Errors below the reference's own are not drawn, compared or on a front."""
        error = curves.error_of(measurement.squares) if measurement.seconds else 0
        return math.isfinite(error) and error > 0 and error >= self.reference.own_error


class Bench:
    """`words` are those of all renders, `folder` is for databases and pictures, `reported` is called with each measurement once it is
    there."""

    def __init__(self, result, options, words, folder, messages, reported):
        self._result, self._options, self._messages, self._reported = result, options, messages, reported
        self._run = [word for word in words if word.split("=")[0] in _OF_RUNS]
        self._picture = [word for word in words if word not in self._run]
        self._folder, self._databases, self._has_base = pathlib.Path(folder), {}, False
        reference = result.reference
        self._groups = pictures.groups_of(reference.pixels)
        self._references = [self._folder / f"reference-{part}.exr" for part in range(len(reference.files))]
        for file, copy in zip(reference.files, self._references):  # which other processes can read
            shutil.copyfile(file, copy)
        self._halves = [pictures.read_exr(copy) for copy in self._references[:2]]

    def measure(self):
        options, measurements, reference = self._options, self._result.measurements, self._result.reference
        sweep = Sweep(self._result.base, reference.tessellations, reference.emitters, options.quick)
        self._add(sweep.points(options.knobs & {"samples"}))
        for measurement in measurements.values():
            self._measure(measurement)
        self._add(sweep.points(options.knobs - {"samples"}, self._least_error()))
        missing = [one for turn in range(options.repeat) for one in measurements.values() if len(one.seconds) <= turn]
        for done, measurement in enumerate(missing):
            self._messages.progress(done, len(missing))
            self._measure(measurement)
        self._messages.progress(1, 1)

    def _add(self, points):
        """The base point is measured first, if it is among the first points: others are compared with its picture."""
        measurements = self._result.measurements
        settings = [point.setting for point in points]
        if not measurements and self._result.base in settings:
            settings.insert(0, self._result.base)
        for setting in settings:
            measurements.setdefault(setting, Measurement(setting))
        self._result.points += points

    def _least_error(self):
        """Adaptive sampling is asked for no error that the reference cannot tell, or that uniform samples do not reach."""
        told = [curves.error_of(one.squares) for one in self._result.measurements.values() if self._result.is_told(one)]
        return max(min(told, default=0) / curves.REACH, self._result.reference.own_error)

    def _measure(self, measurement):
        picture = self._folder / "picture.exr"
        stats = self._render(measurement.setting, picture)
        if not measurement.seconds:
            measurement.rays, measurement.samples = stats["rays"]["total"], stats["sampling"]["samples"]
            measurement.film = stats["film_hash"]
            self._judge(measurement, picture)
        elif measurement.film != stats["film_hash"]:
            raise program.InternalError(f"this is a bug in dmpc, please report it: {measurement.setting} gives several films")
        measurement.seconds.append(stats["seconds"]["render_user"] + stats["seconds"]["render_system"])
        if len(measurement.seconds) == 1:
            self._reported(measurement)

    def _judge(self, measurement, picture):
        setting, base = measurement.setting, self._folder / "base.exr"
        if setting == self._result.base:
            picture = picture.rename(base)
            self._has_base = True
            for in_double in self._references[2:]:
                self._result.arithmetic = pictures.difference(picture, in_double)
        measurement.error = pictures.difference(picture, self._references[0])
        measurement.squares = pictures.square_errors(pictures.read_exr(picture), *self._halves, self._groups)
        if self._has_base and not setting.is_by_paths and not setting.is_refined and setting.samples == self._result.base.samples:
            measurement.deterministic = pictures.difference(picture, base)

    def _render(self, setting, picture):
        """Its counters."""
        stats = self._folder / "stats.json"
        program.run(["render", str(self._database(setting)), *self._of_picture(setting), *setting.words(), *self._run, "--quiet",
                     f"--stats={stats}", f"--output={picture}"])
        return json.loads(stats.read_bytes())

    def _of_picture(self, setting):
        return [*self._picture, *([f"--emitters={setting.emitters}"] if setting.is_by_paths else [])]

    def _database(self, setting):
        """The path of the setting's database, which is built if there is none; what dmpc notes of the scene is said once. It keeps the
        options that it is built with, which --quality would not replace."""
        key = setting.tessellation, setting.emitters
        if key not in self._databases:
            path = self._folder / f"scene-{len(self._databases)}.pages"
            scene = self._result.scene + (f"-t{setting.tessellation}" if setting.tessellation else "")
            layout = _OF_FOREST if "--strategy=forest" in self._run else []
            noted = {} if self._databases else {"noted": self._messages.say}
            program.run(["build", scene, *self._of_picture(setting), f"--samples={self._result.base.samples}", *layout,
                         f"--output={path}"], **noted)
            self._databases[key] = path
        return self._databases[key]
