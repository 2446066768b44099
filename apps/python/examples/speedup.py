"""A study of one's own: how much faster a modelled machine gets by more nodes, and where their time goes, as `dmpc study speedup` has it.

    python3 speedup.py rings-3-t1

`dmpc.sweep` renders by all values of what is a list, on all cores; with runs="FOLDER" it keeps what it has, so that who was stopped goes
on, and who changes what is made of the figures waits for nothing. What figures there are says stats.schema.json.
"""

import sys

import dmpc

PARTS = ["computing", "data_wait", "starvation", "token_wait", "credit_wait", "film_wait", "other_wait", "service_busy", "service_idle", "messages",
         "idle_at_end"]


def speedup(scene, nodes=(1, 2, 4, 8, 16, 32, 64), **options):
    """A frame with a row for each number of nodes; efficiency is against the first."""
    figures = ["virtual_seconds.total", *("time_percent." + part for part in PARTS), "links.wait", "options.node_memory", "run_hash"]
    table = dmpc.sweep(scene, nodes=nodes, runner="virtual", columns=figures, **options)
    node_seconds = table["virtual_seconds.total"] * table["nodes"]
    table.insert(2, "efficiency", 100 * node_seconds.iloc[0] / node_seconds)
    table.insert(2, "speedup", table["efficiency"] / 100 * table["nodes"])
    return table


if __name__ == "__main__":
    print(speedup(sys.argv[1]).to_string(index=False))
