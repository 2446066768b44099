"""The studies: each returns its table as a frame, with units and notes in its attrs.

Written by apps/manual/write.py from what the program says of its options: not to be edited. Where a test says that they
differ: cp build/release/apps/manual/*.py apps/python/dmpc/
"""

from collections.abc import Sequence
from typing import Literal

import pandas

from . import studying
from .calls import sweep
from .program import Text

__all__ = ["sweep", "balance", "traffic", "cache", "speedup", "systems", "frames", "paper", "decades", "references"]


def balance(
    scene: Text, *, nodes: Text | Sequence[Text] | None = None, subsample: int | None = None, topology: Literal["hypercube", "mesh",
    "torus", "fat-tree", "crossbar"] | None = None, per_node: bool = False, camera: Text | None = None, light: Text | Sequence[Text] | None
    = None, fill: Text | None = None, ambient: Text | Sequence[Text] | None = None, background: Text | Sequence[Text] | None = None, scale:
    Text | None = None, up: Literal["x", "y", "z", "-x", "-y", "-z"] | None = None, smooth: Text | None = None, missing: Literal["error",
    "plain"] | Sequence[Text] | None = None, files: Literal["below", "anywhere"] | Sequence[Text] | None = None, sandbox:
    Literal["available", "required"] | None = None, resolution: Text | None = None, depth: int | None = None, convention: Literal["haines",
    "paper"] | None = None, samples: Text | None = None, error: Text | None = None, samples_max: int | None = None, cutoff: Text | None =
    None, quality: Literal["draft", "good"] | None = None, no_skip: Literal["any-hit", "unlit", "zero-terms", "empty-regions", "background",
    "bundles", "idle-nodes", "equal-frames", "all"] | Sequence[Text] | None = None, transport: Literal["whitted", "paths"] | None = None,
    bounces: int | None = None, sky: Text | Sequence[Text] | None = None, emitters: int | None = None, light_radius: Text | None = None,
    clamp: Text | None = None, page_size: Text | None = None, record_order: Literal["spatial", "scattered"] | None = None, structure:
    Literal["grid", "extents", "voxels"] | None = None, voxels: Literal["usual", "article"] | None = None, plots: Text | None = None
) -> pandas.DataFrame:
    """How evenly the work of rays that travel is shared out."""
    return studying.study("balance", ["scene"], locals())


def traffic(
    scene: Text, *, nodes: Text | Sequence[Text] | None = None, camera: Text | None = None, light: Text | Sequence[Text] | None = None,
    fill: Text | None = None, ambient: Text | Sequence[Text] | None = None, background: Text | Sequence[Text] | None = None, scale: Text |
    None = None, up: Literal["x", "y", "z", "-x", "-y", "-z"] | None = None, smooth: Text | None = None, missing: Literal["error", "plain"]
    | Sequence[Text] | None = None, files: Literal["below", "anywhere"] | Sequence[Text] | None = None, sandbox: Literal["available",
    "required"] | None = None, resolution: Text | None = None, depth: int | None = None, convention: Literal["haines", "paper"] | None =
    None, samples: Text | None = None, error: Text | None = None, samples_max: int | None = None, cutoff: Text | None = None, quality:
    Literal["draft", "good"] | None = None, no_skip: Literal["any-hit", "unlit", "zero-terms", "empty-regions", "background", "bundles",
    "idle-nodes", "equal-frames", "all"] | Sequence[Text] | None = None, transport: Literal["whitted", "paths"] | None = None, bounces: int
    | None = None, sky: Text | Sequence[Text] | None = None, emitters: int | None = None, light_radius: Text | None = None, clamp: Text |
    None = None, page_size: Text | None = None, record_order: Literal["spatial", "scattered"] | None = None, structure: Literal["grid",
    "extents", "voxels"] | None = None, voxels: Literal["usual", "article"] | None = None, plots: Text | None = None
) -> pandas.DataFrame:
    """What travels when rays do, beside what travels when pages do."""
    return studying.study("traffic", ["scene"], locals())


def cache(
    scene: Text, *, nodes: int | None = None, cache_pages: Text | Sequence[Text] | None = None, policy: Text | Sequence[Text] | None = None,
    machine: Text | None = None, camera: Text | None = None, light: Text | Sequence[Text] | None = None, fill: Text | None = None, ambient:
    Text | Sequence[Text] | None = None, background: Text | Sequence[Text] | None = None, scale: Text | None = None, up: Literal["x", "y",
    "z", "-x", "-y", "-z"] | None = None, smooth: Text | None = None, missing: Literal["error", "plain"] | Sequence[Text] | None = None,
    files: Literal["below", "anywhere"] | Sequence[Text] | None = None, sandbox: Literal["available", "required"] | None = None, resolution:
    Text | None = None, depth: int | None = None, convention: Literal["haines", "paper"] | None = None, samples: Text | None = None, error:
    Text | None = None, samples_max: int | None = None, cutoff: Text | None = None, quality: Literal["draft", "good"] | None = None,
    no_skip: Literal["any-hit", "unlit", "zero-terms", "empty-regions", "background", "bundles", "idle-nodes", "equal-frames", "all"] |
    Sequence[Text] | None = None, transport: Literal["whitted", "paths"] | None = None, bounces: int | None = None, sky: Text |
    Sequence[Text] | None = None, emitters: int | None = None, light_radius: Text | None = None, clamp: Text | None = None, page_size: Text
    | None = None, record_order: Literal["spatial", "scattered"] | None = None, structure: Literal["grid", "extents", "voxels"] | None =
    None, voxels: Literal["usual", "article"] | None = None, report: Text | None = None, plots: Text | None = None
) -> pandas.DataFrame:
    """How often pages are missed with caches of every size and policy."""
    return studying.study("cache", ["scene"], locals())


def speedup(
    scene: Text, *, nodes: Text | Sequence[Text] | None = None, strategy: Literal["svm", "replicated", "dataflow", "forest"] | None = None,
    node_memory: Text | None = None, machine: Text | None = None, camera: Text | None = None, light: Text | Sequence[Text] | None = None,
    fill: Text | None = None, ambient: Text | Sequence[Text] | None = None, background: Text | Sequence[Text] | None = None, scale: Text |
    None = None, up: Literal["x", "y", "z", "-x", "-y", "-z"] | None = None, smooth: Text | None = None, missing: Literal["error", "plain"]
    | Sequence[Text] | None = None, files: Literal["below", "anywhere"] | Sequence[Text] | None = None, sandbox: Literal["available",
    "required"] | None = None, resolution: Text | None = None, depth: int | None = None, convention: Literal["haines", "paper"] | None =
    None, samples: Text | None = None, error: Text | None = None, samples_max: int | None = None, cutoff: Text | None = None, quality:
    Literal["draft", "good"] | None = None, no_skip: Literal["any-hit", "unlit", "zero-terms", "empty-regions", "background", "bundles",
    "idle-nodes", "equal-frames", "all"] | Sequence[Text] | None = None, transport: Literal["whitted", "paths"] | None = None, bounces: int
    | None = None, sky: Text | Sequence[Text] | None = None, emitters: int | None = None, light_radius: Text | None = None, clamp: Text |
    None = None, page_size: Text | None = None, record_order: Literal["spatial", "scattered"] | None = None, structure: Literal["grid",
    "extents", "voxels"] | None = None, voxels: Literal["usual", "article"] | None = None, plots: Text | None = None, cache_pages: int |
    None = None, homes: Literal["spread", "host", "tree"] | None = None, resident: int | None = None, replacement: Text | None = None,
    in_flight: int | None = None, bundles: bool = False, work_item: int | None = None, work_donor: Literal["ring", "host"] | None = None,
    pixels: Literal["submaps", "interleaved"] | None = None, workers: int | None = None, balance: Literal["subsampled", "equal-size",
    "scattered", "moving"] | None = None, cuts: Literal["longer-side", "alternating"] | None = None, regions: int | None = None, subsample:
    int | None = None, ray_batch: int | None = None, ray_credits: int | None = None, ray_slots: int | None = None, ray_queue: int | None =
    None, tested_objects: int | None = None, no_backpressure: bool = False
) -> pandas.DataFrame:
    """How much faster a modelled machine gets by more nodes."""
    return studying.study("speedup", ["scene"], locals())


def systems(
    scene: Text, *, nodes: Text | Sequence[Text] | None = None, systems: Literal["replicated", "replicated-extents", "svm", "svm-extents",
    "svm-resident", "pixel-machine", "green-paddon", "forest", "forest-static", "equal-size", "scattered", "subsampled", "moving"] |
    Sequence[Text] | None = None, tables: Literal["described", "equal"] | Sequence[Text] | None = None, node_memory: Text | Sequence[Text] |
    None = None, search: bool = False, draws: int | None = None, machine: Text | None = None, camera: Text | None = None, light: Text |
    Sequence[Text] | None = None, fill: Text | None = None, ambient: Text | Sequence[Text] | None = None, background: Text | Sequence[Text]
    | None = None, scale: Text | None = None, up: Literal["x", "y", "z", "-x", "-y", "-z"] | None = None, smooth: Text | None = None,
    missing: Literal["error", "plain"] | Sequence[Text] | None = None, files: Literal["below", "anywhere"] | Sequence[Text] | None = None,
    sandbox: Literal["available", "required"] | None = None, resolution: Text | None = None, depth: int | None = None, convention:
    Literal["haines", "paper"] | None = None, samples: Text | None = None, error: Text | None = None, samples_max: int | None = None,
    cutoff: Text | None = None, quality: Literal["draft", "good"] | None = None, no_skip: Literal["any-hit", "unlit", "zero-terms",
    "empty-regions", "background", "bundles", "idle-nodes", "equal-frames", "all"] | Sequence[Text] | None = None, transport:
    Literal["whitted", "paths"] | None = None, bounces: int | None = None, sky: Text | Sequence[Text] | None = None, emitters: int | None =
    None, light_radius: Text | None = None, clamp: Text | None = None, plots: Text | None = None
) -> pandas.DataFrame:
    """The systems that the 1994 article classifies, side by side on one machine."""
    return studying.study("systems", ["scene"], locals())


def frames(
    scene: Text, *, nodes: Text | Sequence[Text] | None = None, frames: int | None = None, each_frame: bool = False, turntable: Text | None
    = None, camera_path: Text | None = None, machine: Text | None = None, machines: Text | Sequence[Text] | None = None, camera: Text | None
    = None, light: Text | Sequence[Text] | None = None, fill: Text | None = None, ambient: Text | Sequence[Text] | None = None, background:
    Text | Sequence[Text] | None = None, scale: Text | None = None, up: Literal["x", "y", "z", "-x", "-y", "-z"] | None = None, smooth: Text
    | None = None, missing: Literal["error", "plain"] | Sequence[Text] | None = None, files: Literal["below", "anywhere"] | Sequence[Text] |
    None = None, sandbox: Literal["available", "required"] | None = None, resolution: Text | None = None, depth: int | None = None,
    convention: Literal["haines", "paper"] | None = None, samples: Text | None = None, error: Text | None = None, samples_max: int | None =
    None, cutoff: Text | None = None, quality: Literal["draft", "good"] | None = None, no_skip: Literal["any-hit", "unlit", "zero-terms",
    "empty-regions", "background", "bundles", "idle-nodes", "equal-frames", "all"] | Sequence[Text] | None = None, transport:
    Literal["whitted", "paths"] | None = None, bounces: int | None = None, sky: Text | Sequence[Text] | None = None, emitters: int | None =
    None, light_radius: Text | None = None, clamp: Text | None = None, page_size: Text | None = None, record_order: Literal["spatial",
    "scattered"] | None = None, structure: Literal["grid", "extents", "voxels"] | None = None, voxels: Literal["usual", "article"] | None =
    None, plots: Text | None = None
) -> pandas.DataFrame:
    """What frames of a moving camera fetch and send, with caches warm and cold."""
    return studying.study("frames", ["scene"], locals())


def paper(
    *, resolution: int | None = None, sensitivity: bool = False, output: Text | None = None, report: Text | None = None, jobs: int | None =
    None
) -> str:
    """Regenerate the tables and claims of the 1994 article."""
    return studying.study("paper", [], locals())


def decades(
    *, output: Text | None = None, part: Literal["plan", "run", "hold"] | None = None, quick: bool = False, jobs: int | None = None
) -> str:
    """Find what should travel, pages, rays or questions, on machines of 1988 to 2025."""
    return studying.study("decades", [], locals())


def references(
    file: Text, *, page_column: Text | None = None, node_column: Text | None = None, price_column: Text | None = None, cache_pages: Text |
    Sequence[Text] | None = None, policy: Text | Sequence[Text] | None = None, report: Text | None = None, plots: Text | None = None
) -> pandas.DataFrame:
    """Simulate page caches on recorded references, and count misses."""
    return studying.study("references", ["file"], locals())
