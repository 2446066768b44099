"""dmpc from Python: renders on an emulated distributed-memory computer, as arrays and frames.

    import dmpc
    render = dmpc.render("teapot-12", nodes=8, heat=["faults"])
    render.stats["pages"]["faults"], render.nodes, render.film, render.heat["faults"]
    dmpc.sweep("rings-3-t1", nodes=[8, 64], page_size=["1KiB", "4KiB"], runner="virtual")

Every option of `dmpc render` is a keyword, with underscores for dashes. What goes wrong is an exception with dmpc's own words.
"""

from .program import Error, InputError, InternalError, RoomError, UsageError
from .rendering import Render, render
from .sweeping import sweep

__all__ = ["Error", "InputError", "InternalError", "Render", "RoomError", "UsageError", "render", "sweep"]
