"""Many renders: all combinations of some options."""

from . import program, studying


def sweep(options):
    """Renders by all combinations of the options that are lists, arrays or ranges, and returns a frame with a row for each.

    `columns` are names of figures, such as "pages.faults" or "faults"; `runs` a folder in which counters are kept, so that nothing is
    run twice. Raises a program.Error with what dmpc says.
    """
    scene, options = program.scene_of(options)
    columns = program.several(options.pop("columns", ()))
    varied = {name: program.several(value) for name, value in options.items() if program.is_several(value)}
    line = [scene, *program.words({name: value for name, value in options.items() if name not in varied})]
    line += [f"--vary={name.replace('_', '-')}:{_between(list(map(_typed, values)))}" for name, values in varied.items()]
    line += [f"--columns={','.join(columns)}"] if columns else []
    return studying.table("sweep", line)


def _between(values):
    for value in values:
        if ";" in value:
            raise program.UsageError(f"{value}: a value of a sweep has no semicolons")
    return ",".join(values) if not any("," in value for value in values) else ";".join(values) + ";"


def _typed(value):
    return {True: "on", False: "off"}[value] if isinstance(value, bool) else str(value)
