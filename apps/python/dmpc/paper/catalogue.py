"""The runs of the study, by what each is for, and the command line of each.

All but those of `grid` are on the article's own structure and the machine with its prices, with one pixel in flight, without backpressure
and without what later programs skip.
"""

from .data import CELLS, NODES, SCENES, SHARED_KILOBYTES

RINGS = ("rings-3-t1", "rings-4-t1")  # scenes on which travelling rays are compared with travelling pages
LOADED_NODES = (16, 32, 64)  # numbers of nodes for which regions of equal size are cut
ITEM_SIDES = (0, 1, 2, 3, 4, 6, 8)  # of work items; with 0 every node keeps its submap
ARTICLE_ITEM = 3  # the article's compromise
CACHE_NODES = 32  # of the article's cache experiments
# By scene, pages of 1 KB: Rings4, where the network saturates at 204, and Tetra9; from one page to the article's largest.
CACHES = {"Rings4": (1, 4, 16, 51, 102, 204, 408, 811, 1621, 3242), "Tetra9": (1, 4, 16, 51, 102, 204, 408, 724, 1448, 2895)}
# The cells that the prices of ipsc2-1994 are fitted to, the smallest and the largest machine of two scenes, and those of ipsc2.
FITTED = {"article": (("Mountain", 1), ("Mountain", 64), ("Rings4", 2), ("Rings4", 64)), "grid": (("Mountain", 1), ("Mountain", 2))}
LONG_QUEUE = 960  # packets: with everything else they fill nearly all of the article's 4 MB on each of 64 nodes
# Ways for rays to travel on 64 nodes.
RAY_WAYS = {"as in 1994": "--balance=subsampled --cuts=alternating", "longer-side cuts": "--balance=subsampled --cuts=longer-side",
            "equal sizes": "--balance=equal-size --cuts=alternating",
            "long queue": f"--balance=subsampled --cuts=alternating --ray-queue={LONG_QUEUE}"}
BUILT = ("tetra-9", "tetra-10")  # scenes whose databases are kept: every run would take longer to build them than to load them
INNER_LIGHT = "--light=-1,7.36,0.5"  # in the middle of Rings4, in place of its own lights, which are outside

# A blocked shadow ray went no further, and a ray without weight was not shot: all other skips came later.
_EARLY = "--no-skip=unlit --no-skip=empty-regions --no-skip=background --no-skip=bundles --no-skip=idle-nodes"
# The article's program counted rays by this convention and traced all of them; its nodes asked each other for work in turn.
_STRUCTURES = {"voxels": f"--structure=voxels --voxels=article {_EARLY}", "extents": f"--structure=extents {_EARLY}",
               "grid": "--structure=grid --no-skip=background --no-skip=idle-nodes"}
_PAGES, _MEMORY = "--strategy=svm --in-flight=1", "--node-memory=4MiB"


def database_words(name):
    """By which dmpc builds SCENE.STRUCTURE."""
    scene, structure = name.split(".")
    return [scene, *_STRUCTURES[structure].split(" --no-skip")[0].split()]


def line_of(scene, structure, side, nodes, *words, machine="ipsc2-1994"):
    scene = f"databases/{scene}.{structure}.pages" if scene in BUILT else scene
    return " ".join(["render", scene, _STRUCTURES[structure], "--convention=paper", f"--resolution={side}x{side}", f"--nodes={nodes}",
                     "--runner=virtual", f"--machine={machine}", *(word for word in words if word)])


def sizes():
    """Runs of next to nothing that tell how many pages the databases have."""
    names = {(structure, scene.name) for structure in ("voxels", "grid") for scene in SCENES.values()} | {("voxels", RINGS[0])}
    return {name: line_of(name[1], name[0], 8, 1, _PAGES) for name in sorted(names)}


def runs(side, pages):
    """The line of each run, by what it is for. `pages`: of each structure and scene's database."""
    by_pages, by_rays = _by_pages(side, pages), _by_rays(side)
    rings, small = SCENES["Rings4"], SCENES["Teapot"]
    runs = {}
    for title, nodes in CELLS:
        runs["article", title, nodes] = by_pages(SCENES[title].name, nodes)
        runs["grid", title, nodes] = on_grid(side, pages, title, nodes)
    for title, scene in SCENES.items():
        for kind in ("article", "grid"):  # one worker on the smallest printed machine, whose other nodes lend their memories
            runs[kind, title, "one worker"] = runs[kind, title, scene.base] + (" --workers=1" if scene.base > 1 else "")
        runs["counted", title] = by_pages(scene.name, 1, "--count-pages")
        runs["extents", title] = line_of(scene.name, "extents", side, 1, _PAGES)
    for scene in RINGS:
        for nodes in NODES:
            runs["pages", scene, nodes] = by_pages(scene, nodes)
            runs["rays", scene, nodes] = by_rays(scene, nodes, "as in 1994")
        for way in RAY_WAYS:
            runs["way", scene, way] = by_rays(scene, 64, way)
    for nodes in LOADED_NODES:
        runs["equal sizes", nodes] = by_rays(RINGS[0], nodes, "equal sizes")
    for title, sizes in CACHES.items():  # half the resolution: small caches miss so often that a whole picture takes minutes
        runs["cached", title, None] = line_of(SCENES[title].name, "voxels", max(1, side // 2), 1, _PAGES)
        for size in sizes:
            runs["cached", title, size] = line_of(SCENES[title].name, "voxels", max(1, side // 2), CACHE_NODES, _PAGES,
                                                  f"--cache-pages={size}")
    for item in ITEM_SIDES:
        runs["item", item] = by_pages(rings.name, 64, "" if item == ARTICLE_ITEM else f"--work-item={item}")
    for item in (1, ARTICLE_ITEM):
        runs["asked of the host", item] = by_pages(rings.name, 64, "--work-donor=host", f"--work-item={item}")
    runs["lit", "rays"] = by_rays(rings.name, 64, "as in 1994", INNER_LIGHT)
    runs["lit", "pages"] = by_pages(rings.name, 64, INNER_LIGHT)
    runs["copies"] = line_of(small.name, "voxels", side, 64, "--strategy=replicated --in-flight=1", _MEMORY)
    runs["faster"] = by_pages(rings.name, CACHE_NODES, machine="machines/faster.json")
    runs["dearer"] = on_grid(side, pages, *FITTED["grid"][1], machine="machines/dearer.json")
    return runs


def _by_pages(side, pages):
    """One node has the whole scene, however large; others what their own pages leave of the shared memory, at most all others."""
    def line(scene, nodes, *words, machine="ipsc2-1994"):
        if nodes > 1:
            own = -(-pages["voxels", scene] // nodes)
            cache = max(1, min(pages["voxels", scene] - own, int(SHARED_KILOBYTES) - own))
            words = (f"--cache-pages={cache}", _MEMORY, *words)
        return line_of(scene, "voxels", side, nodes, _PAGES, *words, machine=machine)
    return line


def _by_rays(side):
    def line(scene, nodes, way, *words):
        memory = _MEMORY if nodes > 1 else ""
        return line_of(scene, "voxels", side, nodes, "--strategy=dataflow --no-backpressure", RAY_WAYS[way], memory, *words)
    return line


def on_grid(side, pages, title, nodes, machine="ipsc2"):
    """The grid's databases are smaller than the article's, so that the same memory would hold more of them: caches have the article's share
    of the database in place of its bytes."""
    scene = SCENES[title]
    cache = max(1, int(scene.cache_share(nodes) * pages["grid", scene.name] + 0.5))
    return line_of(scene.name, "grid", side, nodes, _PAGES, f"--cache-pages={cache}" if nodes > 1 else "", machine=machine)
