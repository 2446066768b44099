"""The plots of the study: the article's values as marks without a line, ours as lines or bars."""

from ..studies.plots import Plot, Series, of_parts
from ..studies.runs import PARTS
from .catalogue import CACHES, RINGS
from .data import NODES, SCENES


def _of_table_3(name, title, y, printed, found, scenes, is_log):
    series = [Series(f"{scene}, {words}", column, {"scene": scene}, colour, words == "printed") for colour, scene in enumerate(scenes)
              for words, column in (("printed", printed), ("found", found))]
    return Plot(name, title, y, tuple(series), "nodes", is_log=is_log)


def _of_caches(name, title, y, column, *more):
    series = [Series(scene, column, {"scene": scene}, colour) for colour, scene in enumerate(CACHES)]
    return Plot(name, title, y, (*series, *more), "of the database", "cache of a node (% of the database)", 10)


# By table.
PLOTS = {
    "table_2": (Plot("table_2", "Table 2: pages for a pixel, printed and found", "pages for a pixel",
                     (Series("printed", "pages a pixel printed"), Series("found", "pages a pixel", colour=1))),),
    "table_3": (_of_table_3("table_3_seconds", "Table 3: seconds on the iPSC/2, printed and found", "time (s)", "printed", "found",
                            SCENES, True),
                _of_table_3("table_3", "Table 3: efficiency on the iPSC/2, printed and found", "efficiency (%)", "efficiency printed",
                            "efficiency", [title for title, scene in SCENES.items() if scene.base < NODES[-1]], False)),
    "algorithms": (Plot("algorithms", "Figures 5 and 7: efficiency of both algorithms", "efficiency (%)", tuple(
        Series(f"{scene}, {what} travel", f"{what} travel efficiency", {"scene": scene}, colour)
        for colour, (scene, what) in enumerate((scene, what) for scene in RINGS for what in ("pages", "rays"))), "nodes"),),
    "caches": (_of_caches("caches", "Figure 8: efficiency by the size of the cache, 32 nodes", "efficiency (%)", "efficiency"),
               _of_caches("misses", "Figure 9: look-ups that miss, 32 nodes", "miss ratio (%)", "miss ratio"),
               _of_caches("traffic", "Figure 10: pages that a node receives and sends, 32 nodes", "of 0.9 MB/s (%)", "traffic both ways",
                          Series("Rings4, printed", "printed", {"scene": "Rings4"}, 0, True))),
    "losses": (of_parts("losses", "Where the nodes' time goes, computing apart", ("scene", "nodes"), PARTS[1:]),),
    "sensitivity": (Plot("sensitivity", "What a fifth less or more of a figure does to the efficiency on 64 nodes",
                         "change of the efficiency (points)", tuple(
                             Series(f"{scene}, {change}", f"{scene} 64", {"change": change}, colour)
                             for colour, (scene, change) in enumerate((scene, change) for scene in ("Mountain", "Rings4", "Tetra9")
                                                                      for change in ("-20 %", "+20 %"))), places=("figure",)),)}
