"""The scene of a study on a machine, and its runs, which all give the same film."""

import json
import re

from .. import program
from .judging import priced_for
from .runs import CORES, Runs, line_of
from .table import shortest
from .texts import counted


def whole_picture(words):
    """The words of dmpc render that make its picture a study's: a file's is as that of other scenes."""
    given = {word.split("=")[0] for word in words}
    transport = [] if "--transport" in given else ["--transport=whitted"]
    return [*words, *transport, *([] if given & {"--samples", "--quality", "--error"} else ["--samples=1"])]


class Subject:
    """`picture` are words of dmpc render, `folder` is for databases and machines that are no presets, by their names in lines, `figures`
    returns what is kept of the counters of a run. `databases` has the words of each by its name."""

    def __init__(self, scene, picture, machine, folder, messages, figures, jobs=CORES, machines={}):
        self._is_built = scene.endswith(".pages")  # with the words of its own picture and database
        self.scene, self.picture = scene, picture if self._is_built else whole_picture(picture)
        self.machine, self.databases = machine, {}
        self.count, self.films, self._figures, self._asked = 0, {}, figures, None
        self.machines = {}  # with the structures on them, by digest
        self.runs = Runs(folder, jobs, self._kept, self._words, messages.say, messages.progress, machines)

    def _words(self, name):
        return [self.scene, *self.picture, *self.databases[name]]

    def _kept(self, stats):
        frames = stats if isinstance(stats, list) else [stats]
        asked = {key: frames[0][key] for key in ("options", "machine", "machine_digest")}
        return {"films": [frame["film_hash"] for frame in frames], "asked": {**asked, "primitives": frames[0]["database"]["primitives"]},
                **self._figures(stats)}

    def line(self, name, words, machine=None):
        """The command of a run with the database of this name."""
        modelled = ["--runner=virtual", f"--machine={machine}"] if machine else []
        subject = [self.scene, *self.databases[name]] if self._is_built else [f"databases/{name}.pages"]
        return line_of(["render", *subject, *self.picture, *words, *modelled])

    def get(self, lines):
        return list(self.each(lines))

    def each(self, lines):
        """Yields the results of these lines as Runs does. Raises a program.InternalError if a film is another's."""
        for result in self.runs.each(lines):
            if "films" in result:
                self._take(result)
            yield result

    def _take(self, result):
        frame = re.search(r"--frames=(\d+)", result["line"])
        for number, film in enumerate(result["films"], int(frame[1]) if frame else 1):
            self.count += number == 1
            if self.films.setdefault(number, film) != film:
                raise program.InternalError(f"this is a bug in dmpc, please report it: {result['line']} gives another film")
        self._asked = self._asked or result["asked"]
        self.machines.setdefault(result["asked"]["machine_digest"], (result["asked"]["machine"], set()))[1].add(
            result["asked"]["options"]["structure"])

    def fitting(self, lines):
        """Yields them where all should fit. Raises a program.CapacityError with why one does not."""
        for result in self.each(lines):
            if "misfit" in result:
                raise program.CapacityError(result["misfit"])
            yield result

    def database(self, name):
        """The "bytes" and "pages" of a database."""
        line = ["info", self._path(name), *self.picture, "--nodes=1", "--format=json", "--quiet"]
        return json.loads(program.run(line))["database"]

    def _path(self, name):
        return self.scene if self._is_built else str(self.runs.database(name))

    @property
    def asked(self):
        """The counters of a run that say what its options mean: if there is none yet, on one node that has the scene."""
        if self._asked is None:
            database = self._path(next(iter(self.databases)))
            self._asked = self._kept(program.counters(["render", database, *self.picture, "--strategy=replicated", "--nodes=1",
                                                          "--runner=virtual", f"--machine={self.machine}"]))["asked"]
        return self._asked

    @property
    def size(self):
        """Width, height, and samples of a pixel."""
        return tuple(self.asked["options"][name] for name in ("width", "height", "samples"))

    @property
    def text(self):
        """What is rendered, for a title."""
        options, (width, height, samples) = self.asked["options"], self.size
        error, cutoff, structure, rule = (options[name] for name in ("error", "cutoff", "structure", "voxels"))
        return ", ".join([f"{width}x{height} pixels",
                          f"samples refined to an error of {255 * error:.3f}/255" if error else counted(samples, "sample") + " a pixel",
                          *([f"cutoff {255 * cutoff:.3f}/255"] if cutoff else []),
                          f"depth {options['depth']}" if options["transport"] == "whitted" else _paths_text(options),
                          f"convention {options['convention']}", f"record order {options['record_order']}",
                          *([f"structure {structure}" + (f" ({rule})" if rule else "")] if structure != "grid" else []),
                          counted(self.asked["primitives"], "primitive")])

    @property
    def machine_text(self):
        return machine_text(self.asked["machine"], self.asked["machine_digest"])

    def price_notes(self):
        return sorted({note for machine, structures in self.machines.values() for note in price_notes(machine, structures)})

    def film_note(self):
        return f"Film of every run, {self.count} in all: {self.films[1]}." if self.films else "No picture was rendered."


def name_with_links(machine):
    links = " without contention" if not machine["has_contention"] else " with memory ports" if machine["has_memory_port"] else ""
    return machine["name"] + links


def machine_text(machine, digest):
    return f"Machine {name_with_links(machine)} (machine_digest {digest})"


def price_notes(machine, structures):
    """Of structures that the machine has no prices for."""
    known = machine["prices_for"]
    return [f"{machine['name']} has prices for other structures ({', '.join(known)}) than {structure}, so virtual times may be far "
            f"off; {priced_for('ipsc2', structure)} has prices for {structure}."
            for structure in sorted(structures) if known and structure not in known]


def _paths_text(options):
    """paths, 3 bounces, sky 1,1,1."""
    more = (("sky", "sky"), ("light_radius", "lights of radius"), ("clamp", "indirect light clamped to"))
    given = [f"{text} {_plain(options[key])}" for key, text in more if options[key]]
    return ", ".join(["paths", counted(options["bounces"], "bounce"), *given])


def _plain(value):
    return value if isinstance(value, str) else shortest(value)
