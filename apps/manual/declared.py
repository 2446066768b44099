"""What a command line declares, as dmpc_manual_writer writes it: a command is a dict with name, text, examples, arguments, options and commands."""


def leaves(outer, path=""):
    """Pairs of the words typed for a command without subcommands, "study balance", and the command, in the order of declaration."""
    for command in outer["commands"]:
        inner = list(leaves(command, f"{path}{command['name']} "))
        yield from inner or [(path + command["name"], command)]


def value_alone(option):
    """The value without the default in brackets: "1..5" of "1..5 [2]"."""
    return option["value"].split(" [")[0]
