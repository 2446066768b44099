"""Systems on structures, with the options of a run."""

import functools
import json
import re
from dataclasses import dataclass, field, replace

from .. import program
from ..studies.search import Searched

STRUCTURES = ("extents", "grid", "voxels")


@dataclass(frozen=True)
class System:
    name: str
    meaning: str
    options: dict = field(hash=False)  # that define it, by name without dashes, but for its structure
    had: str  # the structure that it had when it was described, or the nearest of ours
    had_what: str  # in words

    @property
    def strategy(self):
        return self.options["strategy"]


@functools.cache
def systems():
    """By name, as dmpc list systems has them."""
    rows = json.loads(program.run(["list", "systems", "--format=json"]))["rows"]
    return {row["name"]: _system(row["name"], row["meaning"]) for row in rows}


def _system(name, meaning):
    text, words, had_what, had = re.fullmatch(r"(.*): (--strategy=.*); it had (.*) \((\w+)\)", meaning).groups()
    options = dict(word.removeprefix("--").split("=") for word in words.split())
    del options["structure"]
    return System(name, text, options, had, had_what)


@dataclass(frozen=True)
class Database:
    structure: str = "grid"
    page: str = "1KiB"
    voxels: str = "usual"  # their rule

    @property
    def words(self):
        rule = [f"--voxels={self.voxels}"] if self.structure == "voxels" else []
        return [f"--structure={self.structure}", f"--page-size={self.page}", *rule]

    @property
    def name(self):
        """Of its file."""
        return f"{self.structure}-{self.voxels}-{self.page}"


@dataclass(frozen=True)
class Setup:
    """A run, but for its scene and machine. `settings` are options beyond those that define the system, by name without dashes."""
    system: System
    database: Database
    nodes: int
    memory: int | None = None  # bytes of a node; None: what the system needs
    settings: dict = field(default_factory=dict, hash=False)

    @property
    def name(self):
        return f"{self.system.name} on {self.database.structure}"

    @property
    def words(self):
        """Of dmpc render."""
        options = {**self.system.options, **self.settings}
        options["no-backpressure"] = options.pop("backpressure", "on") == "off"
        words = [f"--{name}" if value is True else f"--{name}={value}" for name, value in options.items() if value is not False]
        return [*words, f"--nodes={self.nodes}", *([f"--node-memory={self.memory}B"] if self.memory is not None else [])]

    def with_setting(self, setting):
        """The same with values of what is searched; the first value of each is the system's default."""
        given = {option.name: setting[option.name] for option in searched_options(self) if setting[option.name] != option.values[0]}
        database = replace(self.database, page=given.pop("page-size", self.database.page))
        return replace(self, database=database, settings={**self.settings, **given})

    def texts(self, result=None):
        """All options that a verdict has to compare, by name: with what a run took where the setup leaves it open."""
        took = {name: result[name] for name in ("in-flight", "ray-batch") if result and result.get(name)}
        options = {**self.system.options, "structure": self.database.structure}
        if self.system.strategy == "dataflow":
            options |= {"backpressure": self.settings.get("backpressure", "on"),
                        "ray-batch": took.get("ray-batch", self.settings.get("ray-batch", "default"))}
            if options["balance"] != "scattered":
                options["cuts"] = self.settings.get("cuts", "longer-side")
        else:
            donor = self.settings.get("work-donor", options.get("work-donor", "ring"))
            options["work-donor"] = "none" if options.get("work-item") == "0" else donor
        if self.system.strategy in ("svm", "forest"):
            options |= {"page-size": self.database.page, "in-flight": took.get("in-flight", self.settings.get("in-flight", 16))}
        if self.system.strategy == "svm":
            options["resident"] = self.settings.get("resident", options.get("resident", "0"))
        return {name: str(value) for name, value in sorted(options.items())}

    @property
    def free_beforehand(self):
        """What the system finds out before its run, which no virtual time is charged for; None for most."""
        texts = self.texts()
        if texts.get("balance") in ("subsampled", "moving"):
            return "small picture for regions"
        return "small picture for residents" if texts.get("resident", "0") != "0" else None


def described(system, nodes):
    """The system as it had it when it was described: its structure, one pixel in flight, cuts in alternating directions, no
    backpressure."""
    if system.strategy != "dataflow":
        settings = {"in-flight": 1}
    else:
        settings = {"backpressure": "off", **({"cuts": "alternating"} if system.options["balance"] != "scattered" else {})}
    database = Database(system.had, _page_of(system), "article" if system.had == "voxels" else "usual")
    return Setup(system, database, nodes, settings=settings)


def with_whole_cache(setup, page_count):
    """Pages that travel get a cache of the whole database, of so many pages."""
    if setup.system.strategy != "svm":
        return setup
    own = page_count // setup.nodes if setup.system.options.get("homes") == "spread" else 0
    return replace(setup, settings={**setup.settings, "cache-pages": max(1, page_count - own)})


def on_all_structures(names, nodes, memory):
    """The systems, each on every structure that it can walk, with its default options. Those that differ in their structure alone are
    one."""
    chosen = dict.fromkeys(name.removesuffix("-extents") for name in names)
    return [Setup(system, Database(structure, _page_of(system)), nodes, memory) for system in (systems()[name] for name in chosen)
            for structure in STRUCTURES if system.strategy != "forest" or structure == "extents"]


def _page_of(system):
    return "4KiB" if system.strategy == "forest" else "1KiB"


# What the search may try, and of which systems.
_SEARCHED = (
    (Searched("page-size", ("1KiB", "4KiB")), lambda options: options["strategy"] in ("svm", "forest")),
    (Searched("in-flight", ("1", "16", "64")), lambda options: options["strategy"] in ("svm", "forest")),
    (Searched("work-donor", ("ring", "host")),
     lambda options: options["strategy"] != "dataflow" and "work-donor" not in options and options.get("work-item") != "0"),
    (Searched("resident", ("0", "50")), lambda options: options["strategy"] == "svm" and "resident" not in options),
    (Searched("backpressure", ("on", "off")), lambda options: options["strategy"] == "dataflow"),
    (Searched("ray-batch", ("default", "64")), lambda options: options["strategy"] == "dataflow"))
SEARCH = ", ".join(f"{option.name} {{{', '.join(option.values)}}}" for option, _ in _SEARCHED)


def searched_options(setup):
    """Those that the system has and that do not define it, from its defaults on."""
    texts = replace(setup, settings={}).texts()
    return [_from(texts[option.name], option) for option, has in _SEARCHED if has(setup.system.options)]


def _from(default, option):
    return Searched(option.name, (default, *(value for value in option.values if value != default)))
