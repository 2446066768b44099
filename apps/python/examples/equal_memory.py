"""A study of one's own: pages, questions and rays in nodes of the same memory, which is what the better of two systems with rays needs.

    python3 equal_memory.py hdr rings-4-t1 tetra-9

Each row is a scene by Whitted's ray tracing (4 samples) or by paths (3 bounces, 2 samples) on 64 nodes. Rays are the better of scattered
and subsampled regions, pages the best of pages of 1 and 4 KiB with 16 and 64 pixels in flight, questions the better of 16 and 64. Questions
and copies have the memory that they need.
"""

import sys

import pandas

import dmpc

LIGHT = {"whitted": {"transport": "whitted", "samples": 4}, "paths": {"transport": "paths", "bounces": 3, "sky": "1,1,1", "samples": 2}}


def run(scene, **options):
    """Virtual seconds, and bytes of a node's memory; seconds are infinite if the memory is too small."""
    try:
        stats = dmpc.render(scene, runner="virtual", nodes=64, resolution="128x128", **options).stats
    except dmpc.CapacityError:
        return float("inf"), 0
    return stats["virtual_seconds"]["total"], stats["options"]["node_memory"]


def cell(machine, scene, light):
    common = {"machine": machine, **LIGHT[light]}
    rays, memory, regions = min((*run(scene, system=system, **common), system) for system in ("scattered", "subsampled"))
    pages, size, in_flight = min(
        (run(scene, system="svm-extents", page_size=size, in_flight=count, node_memory=f"{memory}B", **common)[0], size, count)
        for size in ("1KiB", "4KiB") for count in (16, 64))
    questions = min(run(scene, system="forest", in_flight=count, **common)[0] for count in (16, 64))
    copies = run(scene, system="replicated-extents", page_size="4KiB", **common)
    return {"machine": machine, "scene": scene, "light": light, "memory (KiB)": memory // 1024, "copies need (KiB)": copies[1] // 1024,
            "regions": regions, "rays (s)": rays, "page size": size, "in flight": in_flight, "pages (s)": pages,
            "questions (s)": questions, "copies (s)": copies[0],
            "rays over pages": rays / pages, "questions over pages": questions / pages}


def table(machine, scenes):
    return pandas.DataFrame([cell(machine, scene, light) for scene in scenes for light in LIGHT])


if __name__ == "__main__":
    print(table(sys.argv[1], sys.argv[2:]).to_csv(index=False, float_format="%.4g"), end="")
