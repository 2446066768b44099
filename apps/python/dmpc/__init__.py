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

import importlib
import importlib.util

from .program import CapacityError, Error, InputError, InternalError, UsageError

# By module: what needs numpy, pandas and OpenImageIO, and is loaded when it is asked for, since dmpc's own studies do without.
_LATER = {"calls": ("compare", "references", "render", "sweep", "trace"), "pages": ("Page", "page"),
          "policies": ("PolicyError", "simulate"), "rendering": ("Render",), "study": ("study",)}
_PLACES = {name: module for module, names in _LATER.items() for name in names}

__all__ = sorted(["CapacityError", "Error", "InputError", "InternalError", "UsageError", *_PLACES])


def __getattr__(name):
    if name not in _PLACES:
        raise AttributeError(f"module dmpc has no attribute {name}")
    missing = [module for module in ("numpy", "pandas", "OpenImageIO") if importlib.util.find_spec(module) is None]
    if missing:
        raise ModuleNotFoundError(f"dmpc.{name} needs {' and '.join(missing)}, which this Python does not have: on Debian, apt install "
                                  f"{' '.join(f'python3-{module.lower()}' for module in missing)}, for /usr/bin/python3", name=missing[0])
    module = importlib.import_module(f".{_PLACES[name]}", __name__)
    found = module if name == "study" else getattr(module, name)
    globals()[name] = found
    return found


def __dir__():
    return __all__
