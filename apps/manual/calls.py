"""The generated files of the module for Python: a function for each command that has one, whose keywords are the command's options, so that
whoever types them is offered what there is; and which values have commas between."""

import re

LINE_WIDTH = 140
ORIGIN = ('Written by apps/manual/write.py from what the program says of its options: not to be edited. Where a test says that they\n'
          'differ: cp build/release/apps/manual/*.py apps/python/dmpc/\n"""\n\n')
FRAMES = {"frames", "turntable", "camera_path", "animation", "fps"}  # options of many pictures, and a call returns one


def keyword(option):
    """ "--node-memory" as "node_memory"."""
    name = option["names"][-1] if option["names"] else option["value"]
    return re.split(r"[.\[]", name.lstrip("-"))[0].replace("-", "_").lower()


def type_of(option):
    """The type of one value: the words of "svm|dataflow [svm]", a number, or any text."""
    shown = option["value"].split(" ")[0]
    words = shown.split("|")
    if len(words) > 1 and all(re.fullmatch(r"[a-z0-9-]+", word) for word in words):
        return f"Literal[{', '.join(f'{chr(34)}{word}{chr(34)}' for word in words)}]"
    return "int" if ".." in shown and re.fullmatch(r"[0-9.]+", shown) else "Text"


def parameter(option, are_several):
    is_flag = not option["value"] or option["has_optional_value"]
    kind = "bool | Text" if option["has_optional_value"] else "bool" if is_flag else type_of(option)
    if are_several or (not is_flag and (option["is_repeatable"] or option["is_list"])):
        kind += f" | Sequence[{'Text' if kind.startswith('Literal') else kind}]"
    return f"{keyword(option)}: {kind} = {'False' if is_flag else 'None'}" if is_flag else f"{keyword(option)}: {kind} | None = None"


def filled(parts):
    """Parts with commas between, in lines."""
    lines = ["   "]
    for word in ", ".join(parts).split():
        if len(lines[-1]) + 1 + len(word) > LINE_WIDTH:
            lines.append("   ")
        lines[-1] += " " + word
    return "\n".join(lines)


def function(name, command, own, result, body, before="", are_several=False):
    """`own`: options that the call sets itself; `before`: keywords that stand before the others; `are_several`: each takes several values."""
    parts = [keyword(argument) + (": Text | Sequence[Text] = ()" if argument["is_list"] else ": Text") for argument in command["arguments"]]
    parts += ["*"] + ([before] if before else [])
    parts += [parameter(option, are_several) for option in command["options"] if keyword(option) not in own]
    return f'\n\ndef {name}(\n{filled(parts)}\n) -> {result}:\n    """{command["text"]}."""\n    return {body}\n'


def named(commands, name):
    return next(command for command in commands if command["name"] == name)


def calls(program):
    commands = program["commands"]
    render, frame = named(commands, "render"), "pandas.DataFrame"
    sweep = named(named(commands, "study")["commands"], "sweep")
    picture = {"help", "output", "quiet", *FRAMES}
    return ('"""What dmpc does, as functions; every option of the program\'s command is a keyword, with underscores for dashes.\n\n' + ORIGIN +
            "from collections.abc import Sequence\nfrom typing import Literal\n\nimport pandas\n\n"
            "from . import comparing, looking, rendering, sweeping\nfrom .program import Text\nfrom .rendering import Render\n" +
            function("render", render, picture | {"stats", "heatmap"}, "Render", "rendering.render(locals())", "heat: Text | Sequence[Text] = ()") +
            function("sweep", sweep, {"help", "vary", "format", "output", "quiet"}, frame, "sweeping.sweep(locals())", are_several=True) +
            function("references", render, picture | {"references"}, frame, "looking.references(locals())") +
            function("trace", render, picture | {"trace"}, frame, "looking.trace(locals())") +
            function("compare", named(commands, "compare"), {"help", "format"}, "dict", "comparing.compare(locals())"))


def study_call(study):
    has_table = any(keyword(option) == "format" for option in study["options"])
    positions = ", ".join(f'"{keyword(argument)}"' for argument in study["arguments"])
    return function(study["name"], study, {"help", "quiet"} | ({"format", "output"} if has_table else set()),
                    "pandas.DataFrame" if has_table else "str", f'studying.study("{study["name"]}", [{positions}], locals())')


def studies(program):
    others = [study for study in named(program["commands"], "study")["commands"] if study["name"] != "sweep"]
    names = ", ".join(f'"{name}"' for name in ["sweep", *(study["name"] for study in others)])
    return ('"""The studies: each returns its table as a frame, with units and notes in its attrs.\n\n' + ORIGIN +
            "from collections.abc import Sequence\nfrom typing import Literal\n\nimport pandas\n\n"
            f"from . import studying\nfrom .calls import sweep\nfrom .program import Text\n\n__all__ = [{names}]\n" +
            "".join(map(study_call, others)))


def all_options(command):
    yield from command["options"]
    for inner in command["commands"]:
        yield from all_options(inner)


def commas(program):
    repeated = {keyword(option) for option in all_options(program) if option["is_repeatable"]}
    lists = {keyword(option) for option in all_options(program) if option["is_list"] and not option["is_repeatable"]}
    return ('"""Options whose several values have commas between; others that take several are given several times.\n\n' + ORIGIN +
            "WITH_COMMAS = {\n" + filled(f'"{name}"' for name in sorted(lists - repeated)) + "\n}\n")
