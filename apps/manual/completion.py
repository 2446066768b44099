"""The completion script for bash: completion.in.bash, with what the program declares in two of its functions."""

import pathlib


def assignment(name, value):
    return f' {name}="{value}"' if value else ""


def value_case(pattern, suggestions, is_list):
    """What may stand for a value: whatever one of the suggestions has."""
    words, endings = ([word for one in suggestions for word in one[kind]] for kind in ("words", "endings"))
    text = (assignment("words", " ".join(words)) + assignment("files", "1" if any(one["files"] for one in suggestions) else "") +
            assignment("endings", " ".join(endings)) + assignment("folders", "1" if any(one["folders"] for one in suggestions) else ""))
    return f"    {pattern}){text}{assignment('is_list', '1' if is_list else '')} ;;\n" if text else ""


def commands(command, path=""):
    """Pairs of the words typed for a command and the command, with all below."""
    yield path, command
    for inner in command["commands"]:
        yield from commands(inner, f"{path} {inner['name']}".strip())


def values(path, command):
    text = value_case(f'"{path}:"', [argument["suggestion"] for argument in command["arguments"]], False)
    for option in command["options"]:
        pattern = " | ".join(f'"{path}:{name}"' for name in option["names"])
        text += value_case(pattern, [option["suggestion"]], option["is_list"])
    return text


def declarations(path, command):
    names = [(name, option["value"]) for option in command["options"] for name in option["names"]]
    options = [name + ("=" if name.startswith("--") and value else "") for name, value in names]
    return (f'    "{path}")' + assignment("commands", " ".join(inner["name"] for inner in command["commands"])) +
            assignment("options", " ".join(options)) + assignment("valued", " ".join(name for name, value in names if value)) + " ;;\n")


def bash_completion(declared):
    script = pathlib.Path(__file__).with_name("completion.in.bash").read_text(encoding="utf-8")
    every = list(commands(declared["program"]))
    return script.replace("@values@", "".join(values(*each) for each in every)).replace("@declarations@",
                                                                                       "".join(declarations(*each) for each in every))
