"""What the study takes from the counters of a run."""

import math
from dataclasses import dataclass, field

from ..studies.runs import PARTS


@dataclass
class Result:
    ns: int = 0
    nodes: int = 1
    film: str = ""
    percent: dict = field(default_factory=lambda: {part: 100.0 if part == "computing" else 0.0 for part in PARTS})
    rays: int = 0
    tests: int = 0  # of rays against primitives
    references: int = 0
    faults: int = 0
    page_bytes: int = 0
    charges: dict = field(default_factory=dict)  # operations that computing was charged for, if pages travelled
    average_load: float = 0.0  # mean over maximum of the nodes' work, if rays travelled
    overflowed: float = 0.0  # packets of rays sent by way of the host, over all
    ray_bytes: int = 0  # of packets with rays, by either way
    flood: float = 0.0  # what comes to a light's region, or from a page's home, over the mean
    pages_a_pixel: float | None = None
    database_bytes: int = 0
    database_pages: int = 0
    primitives: int = 0

    @property
    def seconds(self):
        return 1e-9 * self.ns

    @property
    def miss_ratio(self):
        return self.faults / self.references if self.references else 0.0

    @property
    def page_rate(self):
        """Bytes of pages that a node receives a second."""
        return self.page_bytes / self.nodes / self.seconds


def figures_of(stats):
    """The fields of a Result, from all counters."""
    operations, database = stats["operations"], stats["database"]
    tests = {name: operations[f"{name}s"] for name in ("triangle_test", "sphere_test", "cone_test")}
    found = {"ns": round(1e9 * stats["virtual_seconds"]["total"]), "nodes": len(stats["nodes"]), "film": stats["film_hash"],
             "percent": stats["time_percent"], "rays": stats["rays"]["total"], "tests": sum(tests.values()),
             "database_bytes": database["bytes"], "database_pages": database["pages"], "primitives": database["primitives"]}
    if stats["pages"]:
        pages = stats["pages"]
        found |= {"references": pages["references"], "faults": pages["faults"], "pages_a_pixel": pages["distinct_per_pixel"],
                  "page_bytes": stats["packets"]["by_kind"]["page_reply"]["bytes"],
                  "flood": over_mean([node["pages"]["served"] for node in stats["nodes"]]),
                  "charges": tests | {
                      "ray_setup": stats["rays"]["total"] - stats["skips"]["background"]["avoided"], "cell_step": operations["cell_steps"],
                      "bvh_node_read": operations["bvh_node_reads"], "shading": operations["shadings"], "home_lookup": pages["home_hits"],
                      "cached_lookup": pages["references"] - pages["home_hits"], "page_install": pages["faults"]}}
    if stats["travel"]:
        travel = stats["travel"]
        found |= {"average_load": stats["load"]["average"], "ray_bytes": travel["bytes"],
                  "flood": _flood_at(stats["options"]["light"] or (), stats),
                  "overflowed": travel["overflow"]["packets"] / travel["packets"] if travel["packets"] else 0.0}
    return found


def over_mean(values, one=None):
    """The largest, or one of them, over the mean; 0 of nothing."""
    return (max(values) if one is None else one) * len(values) / sum(values) if sum(values) else 0.0


def _flood_at(lights, stats):
    """Shadow rays that come to the region of a light, of that with the most."""
    grid, shadow = stats["database"]["grid"], [node["travel"]["rays_in"]["shadow"] for node in stats["nodes"]]
    floods = [0.0]
    for light in lights:
        place = [float(each) for each in light.split("/")[0].split(",")]
        cell = [min(max(math.floor((at - low) / grid["cell"]), 0), size - 1)
                for at, low, size in zip(place, grid["low"], stats["regions"]["grid"])]
        floods += [over_mean(shadow, rays) for node, rays in zip(stats["nodes"], shadow)
                   if all(low <= at < high for low, at, high in zip(node["region"]["low"], cell, node["region"]["high"]))]
    return max(floods)
