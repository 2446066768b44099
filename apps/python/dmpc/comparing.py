"""Two pictures, or the counters of two runs, held against each other."""

import json

from . import program

_DIFFERS = 5  # the program's status


def compare(options):
    """What `dmpc compare --format=json` tells, as a dictionary; "differs" says whether a limit is passed or a counter differs, which is
    no error. Raises a program.Error for what cannot be compared."""
    a, b = str(options.pop("a")), str(options.pop("b"))
    found = json.loads(program.run(["compare", "--format=json", *program.words(options), "--", a, b], passing=(_DIFFERS,)))
    program.check_format(found, "what compare tells")
    found["differs"] = bool(found.get("passed_limits") or found.get("differences"))
    return found
