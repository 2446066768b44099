"""dmpc from Python: renders on an emulated distributed-memory computer, as arrays and frames.

    import dmpc
    render = dmpc.render("teapot-12", nodes=8, heat=["faults"])
    render.stats["pages"]["faults"], render.nodes, render.film, render.heat["faults"]
    dmpc.sweep("rings-3-t1", nodes=[8, 64], page_size=["1KiB", "4KiB"], runner="virtual")
    dmpc.study.cache("rings-3-t1", nodes=8)
    dmpc.references("rings-3-t1", nodes=8), dmpc.trace("rings-3-t1", runner="virtual")
    dmpc.compare("new.json", "kept.json")["differs"]
    dmpc.page("rings.html").share["tracing"]

Every option of the program's command is a keyword, with underscores for dashes. What goes wrong is an exception with dmpc's own words.
"""

import importlib.util

_missing = [module for module in ("numpy", "pandas", "OpenImageIO") if importlib.util.find_spec(module) is None]
if _missing:
    raise ModuleNotFoundError(f"dmpc needs {' and '.join(_missing)}, which this Python does not have: on Debian, apt install "
                              f"{' '.join(f'python3-{module.lower()}' for module in _missing)}, for /usr/bin/python3", name=_missing[0])

from . import study
from .calls import compare, references, render, sweep, trace
from .pages import Page, page
from .policies import PolicyError, simulate
from .program import Error, InputError, InternalError, CapacityError, UsageError
from .rendering import Render

__all__ = ["Error", "InputError", "InternalError", "Page", "PolicyError", "Render", "CapacityError", "UsageError", "compare", "page",
           "references", "render", "simulate", "study", "sweep", "trace"]
