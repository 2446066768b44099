"""What dmpc does, as functions; every option of the program's command is a keyword, with underscores for dashes.

Written by apps/manual/write.py from what the program says of its options: not to be edited. Where a test says that they
differ: cp build/release/apps/manual/*.py apps/python/dmpc/
"""

from collections.abc import Sequence
from typing import Literal

import pandas

from . import comparing, looking, rendering, sweeping
from .program import Text
from .rendering import Render


def render(
    scene: Text, *, heat: Text | Sequence[Text] = (), camera: Text | None = None, light: Text | Sequence[Text] | None = None, fill: Text |
    None = None, ambient: Text | Sequence[Text] | None = None, background: Text | Sequence[Text] | None = None, scale: Text | None = None,
    up: Literal["x", "y", "z", "-x", "-y", "-z"] | None = None, smooth: Text | None = None, missing: Literal["error", "plain"] |
    Sequence[Text] | None = None, files: Literal["below", "anywhere"] | Sequence[Text] | None = None, sandbox: Literal["available",
    "required"] | None = None, resolution: Text | None = None, depth: int | None = None, convention: Literal["haines", "paper"] | None =
    None, samples: Text | None = None, error: Text | None = None, samples_max: int | None = None, cutoff: Text | None = None, quality:
    Literal["draft", "good"] | None = None, no_skip: Literal["any-hit", "unlit", "zero-terms", "empty-regions", "background", "bundles",
    "idle-nodes", "equal-frames", "all"] | Sequence[Text] | None = None, transport: Literal["whitted", "paths"] | None = None, bounces: int
    | None = None, sky: Text | Sequence[Text] | None = None, emitters: int | None = None, light_radius: Text | None = None, clamp: Text |
    None = None, nodes: int | None = None, strategy: Literal["svm", "replicated", "dataflow", "forest"] | None = None, system:
    Literal["replicated", "replicated-extents", "svm", "svm-extents", "svm-resident", "pixel-machine", "green-paddon", "forest",
    "forest-static", "equal-size", "scattered", "subsampled", "moving"] | None = None, node_memory: Text | None = None, page_size: Text |
    None = None, record_order: Literal["spatial", "scattered"] | None = None, structure: Literal["grid", "extents", "voxels"] | None = None,
    voxels: Literal["usual", "article"] | None = None, instances: Literal["expand", "keep", "auto"] | None = None, runner:
    Literal["threads", "pool", "virtual", "mpi"] | None = None, pool_threads: int | None = None, rank_timeout: int | None = None, machine:
    Text | None = None, chaos: Text | None = None, cache_pages: int | None = None, homes: Literal["spread", "host", "tree"] | None = None,
    resident: int | None = None, replacement: Text | None = None, in_flight: int | None = None, bundles: bool = False, work_item: int | None
    = None, work_donor: Literal["ring", "host"] | None = None, pixels: Literal["submaps", "interleaved"] | None = None, workers: int | None
    = None, count_pages: bool = False, balance: Literal["subsampled", "equal-size", "scattered", "moving"] | None = None, cuts:
    Literal["longer-side", "alternating"] | None = None, regions: int | None = None, subsample: int | None = None, ray_batch: int | None =
    None, ray_credits: int | None = None, ray_slots: int | None = None, ray_queue: int | None = None, tested_objects: int | None = None,
    no_backpressure: bool = False, tracer: Literal["grid", "embree"] | None = None, report: Text | None = None, aov: Text | Sequence[Text] |
    None = None, trace: Text | None = None, trace_window: Text | Sequence[Text] | None = None, references: Text | None = None, serve: bool |
    Text = False, checkpoint: Text | None = None, checkpoint_every: Text | None = None, resume: bool = False, time: Text | None = None,
    passes: int | None = None
) -> Render:
    """Render a scene on N nodes."""
    return rendering.render(locals())


def sweep(
    scene: Text, *, columns: Text | Sequence[Text] | None = None, runs: Text | Sequence[Text] | None = None, report: Text | Sequence[Text] |
    None = None, plots: Text | Sequence[Text] | None = None, camera: Text | Sequence[Text] | None = None, light: Text | Sequence[Text] |
    None = None, fill: Text | Sequence[Text] | None = None, ambient: Text | Sequence[Text] | None = None, background: Text | Sequence[Text]
    | None = None, scale: Text | Sequence[Text] | None = None, up: Literal["x", "y", "z", "-x", "-y", "-z"] | Sequence[Text] | None = None,
    smooth: Text | Sequence[Text] | None = None, missing: Literal["error", "plain"] | Sequence[Text] | None = None, files: Literal["below",
    "anywhere"] | Sequence[Text] | None = None, sandbox: Literal["available", "required"] | Sequence[Text] | None = None, resolution: Text |
    Sequence[Text] | None = None, depth: int | Sequence[int] | None = None, convention: Literal["haines", "paper"] | Sequence[Text] | None =
    None, samples: Text | Sequence[Text] | None = None, error: Text | Sequence[Text] | None = None, samples_max: int | Sequence[int] | None
    = None, cutoff: Text | Sequence[Text] | None = None, quality: Literal["draft", "good"] | Sequence[Text] | None = None, no_skip:
    Literal["any-hit", "unlit", "zero-terms", "empty-regions", "background", "bundles", "idle-nodes", "equal-frames", "all"] |
    Sequence[Text] | None = None, transport: Literal["whitted", "paths"] | Sequence[Text] | None = None, bounces: int | Sequence[int] | None
    = None, sky: Text | Sequence[Text] | None = None, emitters: int | Sequence[int] | None = None, light_radius: Text | Sequence[Text] |
    None = None, clamp: Text | Sequence[Text] | None = None, nodes: int | Sequence[int] | None = None, strategy: Literal["svm",
    "replicated", "dataflow", "forest"] | Sequence[Text] | None = None, system: Literal["replicated", "replicated-extents", "svm",
    "svm-extents", "svm-resident", "pixel-machine", "green-paddon", "forest", "forest-static", "equal-size", "scattered", "subsampled",
    "moving"] | Sequence[Text] | None = None, node_memory: Text | Sequence[Text] | None = None, page_size: Text | Sequence[Text] | None =
    None, record_order: Literal["spatial", "scattered"] | Sequence[Text] | None = None, structure: Literal["grid", "extents", "voxels"] |
    Sequence[Text] | None = None, voxels: Literal["usual", "article"] | Sequence[Text] | None = None, instances: Literal["expand", "keep",
    "auto"] | Sequence[Text] | None = None, runner: Literal["threads", "pool", "virtual", "mpi"] | Sequence[Text] | None = None,
    pool_threads: int | Sequence[int] | None = None, rank_timeout: int | Sequence[int] | None = None, machine: Text | Sequence[Text] | None
    = None, chaos: Text | Sequence[Text] | None = None, cache_pages: int | Sequence[int] | None = None, homes: Literal["spread", "host",
    "tree"] | Sequence[Text] | None = None, resident: int | Sequence[int] | None = None, replacement: Text | Sequence[Text] | None = None,
    in_flight: int | Sequence[int] | None = None, bundles: bool | Sequence[bool] = False, work_item: int | Sequence[int] | None = None,
    work_donor: Literal["ring", "host"] | Sequence[Text] | None = None, pixels: Literal["submaps", "interleaved"] | Sequence[Text] | None =
    None, workers: int | Sequence[int] | None = None, count_pages: bool | Sequence[bool] = False, balance: Literal["subsampled",
    "equal-size", "scattered", "moving"] | Sequence[Text] | None = None, cuts: Literal["longer-side", "alternating"] | Sequence[Text] | None
    = None, regions: int | Sequence[int] | None = None, subsample: int | Sequence[int] | None = None, ray_batch: int | Sequence[int] | None
    = None, ray_credits: int | Sequence[int] | None = None, ray_slots: int | Sequence[int] | None = None, ray_queue: int | Sequence[int] |
    None = None, tested_objects: int | Sequence[int] | None = None, no_backpressure: bool | Sequence[bool] = False, tracer: Literal["grid",
    "embree"] | Sequence[Text] | None = None, time: Text | Sequence[Text] | None = None, passes: int | Sequence[int] | None = None
) -> pandas.DataFrame:
    """Render all combinations of chosen options, and print chosen counters."""
    return sweeping.sweep(locals())


def references(
    scene: Text, *, camera: Text | None = None, light: Text | Sequence[Text] | None = None, fill: Text | None = None, ambient: Text |
    Sequence[Text] | None = None, background: Text | Sequence[Text] | None = None, scale: Text | None = None, up: Literal["x", "y", "z",
    "-x", "-y", "-z"] | None = None, smooth: Text | None = None, missing: Literal["error", "plain"] | Sequence[Text] | None = None, files:
    Literal["below", "anywhere"] | Sequence[Text] | None = None, sandbox: Literal["available", "required"] | None = None, resolution: Text |
    None = None, depth: int | None = None, convention: Literal["haines", "paper"] | None = None, samples: Text | None = None, error: Text |
    None = None, samples_max: int | None = None, cutoff: Text | None = None, quality: Literal["draft", "good"] | None = None, no_skip:
    Literal["any-hit", "unlit", "zero-terms", "empty-regions", "background", "bundles", "idle-nodes", "equal-frames", "all"] |
    Sequence[Text] | None = None, transport: Literal["whitted", "paths"] | None = None, bounces: int | None = None, sky: Text |
    Sequence[Text] | None = None, emitters: int | None = None, light_radius: Text | None = None, clamp: Text | None = None, nodes: int |
    None = None, strategy: Literal["svm", "replicated", "dataflow", "forest"] | None = None, system: Literal["replicated",
    "replicated-extents", "svm", "svm-extents", "svm-resident", "pixel-machine", "green-paddon", "forest", "forest-static", "equal-size",
    "scattered", "subsampled", "moving"] | None = None, node_memory: Text | None = None, page_size: Text | None = None, record_order:
    Literal["spatial", "scattered"] | None = None, structure: Literal["grid", "extents", "voxels"] | None = None, voxels: Literal["usual",
    "article"] | None = None, instances: Literal["expand", "keep", "auto"] | None = None, runner: Literal["threads", "pool", "virtual",
    "mpi"] | None = None, pool_threads: int | None = None, rank_timeout: int | None = None, machine: Text | None = None, chaos: Text | None
    = None, cache_pages: int | None = None, homes: Literal["spread", "host", "tree"] | None = None, resident: int | None = None,
    replacement: Text | None = None, in_flight: int | None = None, bundles: bool = False, work_item: int | None = None, work_donor:
    Literal["ring", "host"] | None = None, pixels: Literal["submaps", "interleaved"] | None = None, workers: int | None = None, count_pages:
    bool = False, balance: Literal["subsampled", "equal-size", "scattered", "moving"] | None = None, cuts: Literal["longer-side",
    "alternating"] | None = None, regions: int | None = None, subsample: int | None = None, ray_batch: int | None = None, ray_credits: int |
    None = None, ray_slots: int | None = None, ray_queue: int | None = None, tested_objects: int | None = None, no_backpressure: bool =
    False, tracer: Literal["grid", "embree"] | None = None, stats: Text | None = None, report: Text | None = None, heatmap: Text |
    Sequence[Text] | None = None, aov: Text | Sequence[Text] | None = None, trace: Text | None = None, trace_window: Text | Sequence[Text] |
    None = None, serve: bool | Text = False, checkpoint: Text | None = None, checkpoint_every: Text | None = None, resume: bool = False,
    time: Text | None = None, passes: int | None = None
) -> pandas.DataFrame:
    """Render a scene on N nodes."""
    return looking.references(locals())


def trace(
    scene: Text, *, camera: Text | None = None, light: Text | Sequence[Text] | None = None, fill: Text | None = None, ambient: Text |
    Sequence[Text] | None = None, background: Text | Sequence[Text] | None = None, scale: Text | None = None, up: Literal["x", "y", "z",
    "-x", "-y", "-z"] | None = None, smooth: Text | None = None, missing: Literal["error", "plain"] | Sequence[Text] | None = None, files:
    Literal["below", "anywhere"] | Sequence[Text] | None = None, sandbox: Literal["available", "required"] | None = None, resolution: Text |
    None = None, depth: int | None = None, convention: Literal["haines", "paper"] | None = None, samples: Text | None = None, error: Text |
    None = None, samples_max: int | None = None, cutoff: Text | None = None, quality: Literal["draft", "good"] | None = None, no_skip:
    Literal["any-hit", "unlit", "zero-terms", "empty-regions", "background", "bundles", "idle-nodes", "equal-frames", "all"] |
    Sequence[Text] | None = None, transport: Literal["whitted", "paths"] | None = None, bounces: int | None = None, sky: Text |
    Sequence[Text] | None = None, emitters: int | None = None, light_radius: Text | None = None, clamp: Text | None = None, nodes: int |
    None = None, strategy: Literal["svm", "replicated", "dataflow", "forest"] | None = None, system: Literal["replicated",
    "replicated-extents", "svm", "svm-extents", "svm-resident", "pixel-machine", "green-paddon", "forest", "forest-static", "equal-size",
    "scattered", "subsampled", "moving"] | None = None, node_memory: Text | None = None, page_size: Text | None = None, record_order:
    Literal["spatial", "scattered"] | None = None, structure: Literal["grid", "extents", "voxels"] | None = None, voxels: Literal["usual",
    "article"] | None = None, instances: Literal["expand", "keep", "auto"] | None = None, runner: Literal["threads", "pool", "virtual",
    "mpi"] | None = None, pool_threads: int | None = None, rank_timeout: int | None = None, machine: Text | None = None, chaos: Text | None
    = None, cache_pages: int | None = None, homes: Literal["spread", "host", "tree"] | None = None, resident: int | None = None,
    replacement: Text | None = None, in_flight: int | None = None, bundles: bool = False, work_item: int | None = None, work_donor:
    Literal["ring", "host"] | None = None, pixels: Literal["submaps", "interleaved"] | None = None, workers: int | None = None, count_pages:
    bool = False, balance: Literal["subsampled", "equal-size", "scattered", "moving"] | None = None, cuts: Literal["longer-side",
    "alternating"] | None = None, regions: int | None = None, subsample: int | None = None, ray_batch: int | None = None, ray_credits: int |
    None = None, ray_slots: int | None = None, ray_queue: int | None = None, tested_objects: int | None = None, no_backpressure: bool =
    False, tracer: Literal["grid", "embree"] | None = None, stats: Text | None = None, report: Text | None = None, heatmap: Text |
    Sequence[Text] | None = None, aov: Text | Sequence[Text] | None = None, trace_window: Text | Sequence[Text] | None = None, references:
    Text | None = None, serve: bool | Text = False, checkpoint: Text | None = None, checkpoint_every: Text | None = None, resume: bool =
    False, time: Text | None = None, passes: int | None = None
) -> pandas.DataFrame:
    """Render a scene on N nodes."""
    return looking.trace(locals())


def compare(
    a: Text, b: Text, *, difference: Text | None = None, flip: Text | None = None, report: Text | None = None, fail_above: Text |
    Sequence[Text] | None = None, only: Text | Sequence[Text] | None = None, tolerance: Text | Sequence[Text] | None = None, sandbox:
    Literal["available", "required"] | None = None
) -> dict:
    """Measure the difference of two pictures, or compare the counters of two runs."""
    return comparing.compare(locals())
