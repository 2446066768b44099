"""The design: which machines, scenes and memories, which systems with which options, and which of their combinations are cells."""

from dataclasses import dataclass

from ..studies.search import Searched

MACHINES = {"ipsc2": 1988, "paragon": 1993, "myrinet": 2005, "fdr": 2015, "hdr": 2022, "ndr": 2025}
STEPS = 8  # of memory: from the least with which pages work to what whole copies need, in equal factors
WHOLE = STEPS - 1

LIGHTS = {
    "whitted": ("--samples=4",),
    "paths-0": ("--transport=paths", "--sky=1", "--samples=16", "--bounces=0"),
    "paths-1": ("--transport=paths", "--sky=1", "--samples=16", "--bounces=1"),
    "paths-3": ("--transport=paths", "--sky=1", "--samples=16", "--bounces=3"),
}
RESOLUTIONS = {8: 64, 64: 64, 512: 128}  # pixels a side, by nodes: at least 32 pixels a node

# Scenes by their triangles, and what they are rendered with; those that take long to build are built once, as files.
SCENES = {
    "mount-6-t6": (9_920, ()),
    "rings-4-t1": (18_002, ()),
    "landscape-8": (65_538, ()),
    "tetra-9": (262_144, ()),
    "tetra-10": (1_048_576, ()),
    "mount-11": (8_388_612, ()),
    "grove-5": (1_000_000, ("--instances=keep",)),
}
BUILT = ("landscape-8", "tetra-9", "tetra-10", "mount-11", "grove-5")

FAMILIES = {"pages": "P", "questions": "Q", "rays": "R", "copies": "C"}


PAGE = Searched("page-size", ("1KiB", "4KiB"))
FLIGHT = Searched("in-flight", ("16", "1", "64"))
DONOR = Searched("work-donor", ("ring", "host"))
RESIDENT = Searched("resident", ("0", "50"))
RAYS = (Searched("no-backpressure", ("off", "on")), Searched("ray-batch", ("default", "64")))
SPACE = Searched("structure", ("extents", "grid", "voxels"))
GRID = Searched("structure", ("grid", "extents", "voxels"))


@dataclass(frozen=True)
class System:
    name: str
    family: str
    words: tuple  # that define it
    searched: tuple  # values from the system's default on


SYSTEMS = {each.name: each for each in (
    System("replicated", "copies", ("--strategy=replicated",), (SPACE, Searched("page-size", ("4KiB", "1KiB")), DONOR)),
    System("svm", "pages", ("--strategy=svm",), (SPACE, PAGE, FLIGHT, DONOR, RESIDENT)),
    System("pixel-machine", "pages", ("--strategy=svm", "--work-item=0", "--pixels=interleaved", "--homes=host"),
           (SPACE, PAGE, FLIGHT, RESIDENT)),
    System("green-paddon", "pages", ("--strategy=svm", "--work-donor=host", "--resident=50", "--homes=tree"), (SPACE, PAGE, FLIGHT)),
    System("forest", "questions", ("--strategy=forest", "--structure=extents"), (PAGE, Searched("in-flight", ("16", "64")), DONOR)),
    System("forest-static", "questions", ("--strategy=forest", "--structure=extents", "--work-item=0", "--pixels=interleaved"),
           (PAGE, Searched("in-flight", ("16", "64")))),
    System("equal-size", "rays", ("--strategy=dataflow", "--balance=equal-size"), (GRID, *RAYS)),
    System("scattered", "rays", ("--strategy=dataflow", "--balance=scattered", "--regions=16"),
           (GRID, *RAYS)),
    System("subsampled", "rays", ("--strategy=dataflow", "--balance=subsampled"),
           (GRID, *RAYS)),
    System("moving", "rays", ("--strategy=dataflow", "--balance=moving", "--regions=16"),
           (GRID, *RAYS)),
)}


@dataclass(frozen=True)
class Cell:
    """What has one winner: a machine, a memory, a number of nodes and a way of lighting, over some scenes."""
    set: str
    machine: str
    step: int
    nodes: int
    light: str
    scenes: tuple

    @property
    def key(self):
        """By which predictions name it; cells of other sizes have a scene each."""
        return f"{self.set} {self.machine} {self.step} {self.nodes} {self.light}" + (f" {self.scenes[0]}" if self.set == "size" else "")


@dataclass(frozen=True)
class Design:
    systems: tuple  # the names of those that are searched
    scouts: tuple  # scenes on which options are searched
    steps: tuple
    scenes: tuple
    kept: int  # settings of a family that other scenes try
    draws: int
    draws_least: int
    sets: tuple = ()

    def map_cells(self):
        return [Cell("map", machine, step, 64, "whitted", self.scenes) for machine in MACHINES for step in self.steps]

    def cells(self):
        return self.map_cells() + [Cell(name, machine, step, nodes, light, scenes) for name, nodes, light, steps, scenes in self.sets
                                   for machine in MACHINES for step in steps]


_LIT, _OTHER = (1, 4), (4,)
WHOLE_DESIGN = Design(
    systems=tuple(SYSTEMS), scouts=("rings-4-t1", "tetra-9"), steps=tuple(range(STEPS)),
    scenes=("rings-4-t1", "landscape-8", "tetra-9", "tetra-10"), kept=1, draws=100, draws_least=20,
    sets=(*(("light", 64, light, _LIT, ("rings-4-t1", "landscape-8")) for light in LIGHTS if light != "whitted"),
          ("nodes", 8, "whitted", _OTHER, ("rings-4-t1", "tetra-9")), ("nodes", 512, "whitted", _OTHER, ("rings-4-t1", "tetra-9")),
          *(("size", 64, "whitted", _OTHER, (scene,)) for scene in ("mount-6-t6", "mount-11", "grove-5"))))
QUICK_DESIGN = Design(
    systems=("replicated", "svm", "forest", "scattered", "subsampled"), scouts=("rings-4-t1", "tetra-9"), steps=(1, 4, 7),
    scenes=("rings-4-t1", "tetra-9"), kept=1, draws=10, draws_least=10)
