"""Many renders: all combinations of some options."""

import json

import pandas

from . import program


def sweep(scene, *, columns=(), runs=None, **options):
    """Renders `scene` by all combinations of the options that are lists, arrays or ranges, and returns a frame with a row for each.

    `columns` are names of figures, such as "pages.faults" or "faults"; `runs` a folder in which counters are kept, so that
    nothing is run twice. The frame's attrs have the table's "units" by column and its "notes". Raises a program.Error with what
    dmpc says.
    """
    program.check_scene(scene, options)
    varied = {name: list(value) for name, value in options.items() if program.is_several(value)}
    fixed = {name: value for name, value in options.items() if name not in varied}
    line = ["study", "sweep", str(scene), "--format=json", *program.words({"runs": runs, **fixed})]
    line += [f"--vary={name.replace('_', '-')}:{','.join(map(_typed, values))}" for name, values in varied.items()]
    line += [f"--columns={','.join(program.several(columns))}"] if len(columns) else []
    table = json.loads(program.run([*line, "--quiet"]))
    program.check_format(table, "the table of study sweep")
    frame = pandas.DataFrame(table["rows"], columns=[column["name"] for column in table["columns"]])
    frame.attrs = {"units": {column["name"]: column["unit"] for column in table["columns"]}, "notes": table["notes"]}
    return frame


def _typed(value):
    return {True: "on", False: "off"}[value] if isinstance(value, bool) else str(value)
