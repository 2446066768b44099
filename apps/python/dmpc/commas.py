"""Options whose several values have commas between; others that take several are given several times.

Written by apps/manual/write.py from what the program says of its options: not to be edited. Where a test says that they
differ: cp build/release/apps/manual/*.py apps/python/dmpc/
"""

WITH_COMMAS = {
    "ambient", "background", "cache_pages", "columns", "knobs", "machines", "node_memory", "nodes", "parts", "reference_samples", "sky",
    "tests", "threads", "trace_window"
}
