"""Studies: the tables that `dmpc study` prints, as frames."""

import json

import pandas

from . import program


def study(name, positions, options):
    """What dmpc.study.NAME() was given: `positions` are those of its options that have no name on the command line. A frame, or what is
    printed of a study that has no table of its own. Raises a program.Error with what dmpc says."""
    if options.get("scene") is not None and "scene" in positions:
        program.scene_of(options)
    arguments = [str(each) for position in positions for each in program.several(options[position])]
    line = [*program.words({key: value for key, value in options.items() if key not in positions}), "--", *arguments]
    return program.run(["study", name, "--quiet", *line]) if name in ("paper", "decades") else table(name, line)


def table(name, line):
    """A study's table as a frame, whose attrs have "units" by column, and "notes"."""
    found = json.loads(program.run(["study", name, "--format=json", "--quiet", *line]))
    program.check_format(found, f"the table of study {name}")
    frame = pandas.DataFrame(found["rows"], columns=[column["name"] for column in found["columns"]])
    frame.attrs = {"units": {column["name"]: column["unit"] for column in found["columns"]}, "notes": found["notes"]}
    return frame
