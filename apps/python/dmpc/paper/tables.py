"""The tables of the study: the article's printed values beside ours."""

from dataclasses import dataclass
from statistics import mean

from ..studies.runs import PARTS
from ..studies.table import Column, Table
from ..studies.texts import counted
from .catalogue import ARTICLE_ITEM, CACHE_NODES, CACHES, FITTED, ITEM_SIDES, LOADED_NODES, LONG_QUEUE, RAY_WAYS, RINGS
from .data import CELLS, NETWORK_RATE, NODES, PEAK_PAGES, PEAK_SHARE, SCENES, Scene, efficiency
from .fits import law_machines, law_of
from .results import Result


@dataclass(frozen=True)
class Cell:
    """A cell of Table 3."""

    scene: Scene
    nodes: int
    is_fitted: bool  # the machine's prices were fitted to it
    found: Result
    base: Result  # of the scene's smallest machine
    one_worker: Result

    @property
    def printed(self):
        return self.scene.seconds[self.nodes]

    @property
    def printed_ray(self):
        """Node-milliseconds of a ray."""
        return 1000 * self.printed * self.nodes / self.scene.rays

    @property
    def ratio(self):
        """Found over printed. Both are per ray, since ours are slightly fewer than the article's (Table 2), and prices are those of a
        ray."""
        return 1000 * self.found.seconds * self.nodes / self.found.rays / self.printed_ray

    @property
    def efficiency(self):
        return efficiency(self.base.seconds, self.scene.base, self.found.seconds, self.nodes)

    @property
    def difference(self):
        return self.efficiency - self.scene.efficiency(self.nodes)

    @property
    def efficiency_by_worker(self):
        return efficiency(self.one_worker.seconds, 1, self.found.seconds, self.nodes)

    @property
    def is_base(self):
        return self.nodes == self.scene.base

    @property
    def is_predicted(self):
        """Whether the efficiency is neither fitted nor 100 % by definition."""
        return not self.is_fitted and not self.is_base


def cells_of(found, kind):
    """Of "article" or "grid", scene by scene."""
    return [Cell(SCENES[title], nodes, (title, nodes) in FITTED[kind], found[kind, title, nodes], found[kind, title, SCENES[title].base],
                 found[kind, title, "one worker"]) for title, nodes in CELLS]


@dataclass(frozen=True)
class Errors:
    """Of cells that are not fitted: the times of a ray as shares of the printed ones, of all scenes and without Teapot, which is another
    scene, and the efficiencies in points; all as sizes."""

    times: list
    times_without_teapot: list
    efficiencies: list


def errors_of(cells):
    free = [cell for cell in cells if not cell.is_fitted]
    return Errors([abs(cell.ratio - 1) for cell in free], [abs(cell.ratio - 1) for cell in free if cell.scene.title != "Teapot"],
                  [abs(cell.difference) for cell in cells if cell.is_predicted])


def errors_text(times):
    return f"{100 * mean(times):.1f} % in the mean and {100 * max(times):.1f} % at worst, {counted(len(times), 'cell')}"


def columns(*described):
    """Columns of "name", or of a name with a unit and digits: "pages a pixel||2"."""
    return [Column(name, unit, int(digits or 0)) for name, unit, digits in ((each + "||").split("|")[:3] for each in described)]


def table_of(title, described, rows, *notes):
    table = Table(title, columns(*described))
    for row in rows:
        table.add(row)
    for note in notes:
        table.note(note)
    return table


def at_a_glance(found):
    cells = {(cell.scene.title, cell.nodes): f"{cell.printed} / {cell.found.seconds:.0f}{' *' if cell.is_fitted else ''}"
             for cell in cells_of(found, "article")}
    return table_of("Table 3 at a glance: seconds printed / found", ("scene", *(counted(nodes, "node") for nodes in NODES)),
                  [[title, *(cells.get((title, nodes)) for nodes in NODES)] for title in SCENES],
                  "*: fitted. Where a cell is empty the article prints nothing.")


def table_2(found):
    rows = []
    for title, scene in SCENES.items():
        result = found["counted", title]
        kilobytes = result.database_bytes // 1024
        rows.append([title, scene.name, scene.polygons, result.primitives, scene.rays, result.rays, scene.kilobytes, kilobytes,
                     kilobytes / scene.kilobytes, scene.pages_a_pixel, result.pages_a_pixel, result.pages_a_pixel / scene.pages_a_pixel])
    return table_of(
        "Table 2: scenes, rays, database",
        ("scene", "ours", "polygons printed", "polygons", "rays printed", "rays", "database printed|KB", "database|KB",
         "database over printed||3", "pages a pixel printed||2", "pages a pixel||2", "pages over printed||3"), rows,
        "Rays and scenes: " + "; ".join(f"{title}, {scene.remark}" for title, scene in SCENES.items()) + ".",
        "The structure is a plain grid of voxels, each with a list of polygons: 14 voxels a polygon, at most 64x64x64; 4 bytes a voxel and "
        "a reference, 129 a polygon; z fastest. These six were chosen so that this table comes out, so it is no prediction, but for "
        "Teapot, which is another scene. Nothing was fitted to figures, misses or balance.")


def table_3(found):
    return _table_3_of(
        found, "article", "Table 3: seconds on the iPSC/2, and efficiencies",
        "Memories of 4 MB, of which 3.2 serve the shared memory, in pages of 1 KB: the article's bytes. A ray's time is the nodes' over "
        "the rays, since ours are not quite as many as the article's (Table 2). Of cells that are fitted neither seconds nor efficiencies "
        "are predictions; of a base the seconds are.")


def grid_table_3(found):
    return _table_3_of(
        found, "grid", "Table 3 on dmpc's grid, with the prices of the preset ipsc2",
        "Its databases are smaller than the article's, so caches hold the share of the database that they held there: of 3.2 MB shared "
        "memory a node, what its own pages leave. Two figures of the machine are fitted to two cells.")


def _table_3_of(found, kind, title, note):
    cells = cells_of(found, kind)
    errors = errors_of(cells)
    return table_of(
        title, ("scene", "nodes", "printed|s|0", "found|s|1", "found over printed||3", "the same a ray||3", "efficiency printed|%|1",
                "efficiency|%|1", "difference|points|1", "one worker|s|0", "efficiency against it|%|1", "use"),
        [[cell.scene.title, cell.nodes, float(cell.printed), cell.found.seconds, cell.found.seconds / cell.printed, cell.ratio,
          cell.scene.efficiency(cell.nodes), cell.efficiency, cell.difference, cell.one_worker.seconds, cell.efficiency_by_worker,
          "fitted" if cell.is_fitted else "base" if cell.is_base else "predicted"] for cell in cells],
        "Efficiencies: against the scene's smallest printed machine. One worker: a node renders, the others of that machine lend it their "
        "memories, as the article estimated times on one node.",
        f"Predicted times of a ray lie off by {errors_text(errors.times)}; without Teapot, which is another scene, by "
        f"{errors_text(errors.times_without_teapot)}. Predicted efficiencies differ by {mean(errors.efficiencies):.2f} points on average "
        f"and {max(errors.efficiencies):.2f} at worst, {counted(len(errors.efficiencies), 'cell')}.", note)


def losses(found):
    return table_of("Where the nodes' time goes", ("scene", "nodes", *(f"{part}|%|2" for part in PARTS)),
                  [[cell.scene.title, cell.nodes, *(cell.found.percent[part] for part in PARTS)] for cell in cells_of(found, "article")],
                  "The parts of a row add up to 100 %. Dearer look-ups of cached pages are part of computing.")


def against_one(found, scene, result):
    """The efficiency against one node that has the whole scene at home."""
    return efficiency(found["pages", scene, 1].seconds, 1, result.seconds, result.nodes)


def algorithms(found):
    rows = [[scene, nodes, rays.seconds, pages.seconds, against_one(found, scene, rays), against_one(found, scene, pages)]
            for scene in RINGS for nodes in NODES for rays, pages in [(found["rays", scene, nodes], found["pages", scene, nodes])]]
    return table_of(
        "Figures 5 and 7: efficiency of both algorithms",
        ("scene", "nodes", "rays travel|s|1", "pages travel|s|1", "rays travel efficiency|%|1", "pages travel efficiency|%|1"), rows,
        "Efficiencies: both against one node that has the whole scene at home. Memories of 4 MB. The curves of the article are not printed "
        "as numbers.",
        "In the article Rings4 by travelling rays did not fit into the memories of 2 and 4 nodes; here a node's part of it does.")


def ray_ways(found):
    rows = [[scene, way, result.seconds, against_one(found, scene, result), 100 * result.average_load, 100 * result.overflowed,
             result.ray_bytes, result.tests] for scene in RINGS for way in RAY_WAYS for result in [found["way", scene, way]]]
    return table_of(
        "Ways for rays to travel, on 64 nodes",
        ("scene", "way", "seconds|s|0", "efficiency|%|1", "average load|%|1", "by way of the host|%|2", "traffic|bytes", "tests"), rows,
        "As in 1994: regions from a subsampled picture, cut in alternating directions, and no backpressure: nodes start primary rays "
        "whatever waits, and what finds no room in the queue goes by way of the host. The other rows differ in what they are named for. A "
        f"long queue is one of {LONG_QUEUE} packets of 8 rays, which fill the node's 4 MiB; else there are 512 of them at most. "
        "Efficiencies as in Figures 5 and 7.")


def region_loads(found):
    one = found["rays", RINGS[0], 1].tests
    rows = [[regions, nodes, 100 * result.average_load, result.seconds, result.tests / one, 100 * result.overflowed]
            for regions, key in (("subsampled", ("rays", RINGS[0])), ("of equal size", ("equal sizes",)))
            for nodes in LOADED_NODES for result in [found[*key, nodes]]]
    return table_of(
        "The load of Rings3's regions",
        ("regions", "nodes", "average load|%|1", "seconds|s|0", "tests over one node's||3", "by way of the host|%|2"), rows,
        "Mean over maximum of the nodes' work; the article has about 82.5 % and less than 20 %, and does not say on how many nodes. "
        "Regions whose border runs through a voxel test what lies on both sides again, and spare what lies on the other: in the loads both "
        "are counted.")


def item_text(side):
    return f"{side}x{side}" if side else "static"


def work_items(found):
    runs = [(side, "ring" if side else "nobody", found["item", side]) for side in ITEM_SIDES]
    runs += [(side, "host", found["asked of the host", side]) for side in (1, ARTICLE_ITEM)]
    parts = ("computing", "data_wait", "starvation", "messages", "idle_at_end")
    return table_of(
        "Work items of Rings4 on 64 nodes",
        ("item", "asked of", "seconds|s|0", "computing|%|1", "data wait|%|2", "starvation|%|2", "messages|%|2", "idle at the end|%|2",
         "faults"),
        [[item_text(side), donor, result.seconds, *(result.percent[part] for part in parts), result.faults]
         for side, donor, result in runs],
        "Static: every node renders its own submap, whatever others have left. By the ring a node asks for items when its submap is done; "
        "by the host it asks for every item, and has no submap.")


def network_share(result):
    """The pages that a node receives and sends, as a share of what messages of 1 KB allow."""
    return 2 * result.page_rate / NETWORK_RATE


def caches(found):
    rows = []
    for title, sizes in CACHES.items():
        for size in sizes:
            base, result = found["cached", title, None], found["cached", title, size]
            rows.append([title, size, 100 * size / SCENES[title].kilobytes, efficiency(base.seconds, 1, result.seconds, CACHE_NODES),
                         result.faults, 100 * result.miss_ratio, result.page_rate, 100 * network_share(result),
                         100 * PEAK_SHARE if (title, size) == ("Rings4", PEAK_PAGES) else None, result.percent["data_wait"],
                         result.percent["service_busy"]])
    many = next(cell for cell in cells_of(found, "article") if (cell.scene.title, cell.nodes) == ("Rings4", CACHE_NODES))
    return table_of(
        "Figures 8 to 10: caches on 32 nodes",
        ("scene", "cache|pages", "of the database|%|3", "efficiency|%|1", "faults", "miss ratio|%|3", "pages received|bytes/s|0",
         "traffic both ways|% of 0.9 MB/s|1", "printed|% of 0.9 MB/s|0", "page wait|%|1", "service_busy|%|1"), rows,
        "Efficiencies: against one node that has all pages at home, as in Figures 5 and 7. Those of Table 3 are against the smallest "
        f"printed machine, whose pages lie on other nodes, too: Rings4 on 32 nodes with all of the 4 MB has {many.efficiency:.1f} % there, "
        f"and {against_one(found, many.scene.name, many.found):.1f} % here. The article does not say which base its figures have.",
        "Both ways: the pages that a node receives and sends, over the 0.9 MB/s that messages of 1 KB allow. The article prints 70 % of "
        "that at the peak, with 204 pages. With one pixel in flight a node asks for a page only when the one before has come, so its "
        "traffic grows as long as the cache shrinks, until it does little else than wait.",
        "Pictures of half the resolution a side: small caches miss so often that a whole one takes minutes.")


def law(found):
    """How far our efficiencies and the law's lie off the printed ones: over all cells that we predict, over those to which neither was
    fitted, and on the largest machine."""
    cells = [cell for cell in cells_of(found, "article") if cell.is_predicted]

    def by_law(cell):
        law, base = law_of(cell.scene), cell.scene.base
        return abs(efficiency(law.seconds(base), base, law.seconds(cell.nodes), cell.nodes) - cell.scene.efficiency(cell.nodes))

    rows = []
    for name, is_meant in (("all that we predict", lambda cell: True),
                           ("of them, those that the law was not fitted to", lambda cell: cell.nodes not in law_machines(cell.scene)),
                           ("those of up to 32 nodes", lambda cell: cell.nodes < 64), ("those of 64 nodes", lambda cell: cell.nodes == 64)):
        ours, laws = zip(*((abs(cell.difference), by_law(cell)) for cell in cells if is_meant(cell)))
        rows.append([name, len(ours), mean(ours), mean(laws), max(ours), max(laws)])
    laws = "; ".join(f"{title} {law.one_node:.0f} s and {law.dearer:.3f}"
                     for title, law in zip(SCENES, map(law_of, SCENES.values())) if law)
    return table_of(
        "Efficiencies of Table 3 by our model and by a law of two parameters",
        ("cells", "number", "our mean error|points|2", "the law's mean error|points|2", "our worst error|points|2",
         "the law's worst error|points|2"),
        rows, "The law: N nodes take A (1 + c (N - 1) / N) node-seconds. A and c go through the two smallest printed machines of each "
        f"scene, eight cells of four scenes: {laws}; our prices were fitted to four cells of two.")
