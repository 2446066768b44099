"""The program dmpc: found, called, and what it says when it fails."""

import os
import shutil
import subprocess

FORMAT = 1  # of its JSON files


class Error(Exception):
    """dmpc did not do what it was asked for; the message is its own."""


class InputError(Error):
    """Bad input, or an output that cannot be written."""


class UsageError(Error):
    """Options that there are none, or that do not go together."""


class InternalError(Error):
    """An error of dmpc's own."""


class RoomError(Error):
    """There is no room, on this computer or in the nodes' memory: the message says what would do."""


_ERRORS = {1: InputError, 2: UsageError, 3: InternalError, 4: RoomError}


def path():
    """The program: what the environment's DMPC names, or else the first dmpc of PATH."""
    found = shutil.which(os.environ.get("DMPC", "dmpc"))
    if found is None:
        wanted = os.environ.get("DMPC")
        raise FileNotFoundError(
            f"DMPC={wanted}: there is no such program" if wanted else
            "there is no program dmpc on PATH: install the package dmpc, or let the environment's DMPC name the program")
    return found


def is_several(value):
    """Whether it is a list, an array or whatever else has elements; text is one value, and so is a path."""
    return hasattr(value, "__iter__") and not isinstance(value, (str, bytes, os.PathLike))


def several(value):
    return list(value) if is_several(value) else [value]


def check_scene(scene, options):
    """Raises a UsageError for what would be an option in a scene's place, or would print help and render nothing."""
    if str(scene).startswith("-"):
        raise UsageError(f"{scene}: expected a scene's name or file; options are named arguments, such as nodes=8")
    if "help" in options:
        raise UsageError("help: no option of what is called from Python; `dmpc render --help` prints what there are")


def words(options):
    """Options as dmpc's words: node_memory="4MiB" is --node-memory=4MiB, True a flag, a list several times the option."""
    line = []
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        for each in several(value):
            if each is True:
                line.append(option)
            elif each is not None and each is not False:
                line.append(f"{option}={each}")
    return line


def run(line):
    """What dmpc prints. Raises an Error with what it says on stderr."""
    done = subprocess.run([path(), *line], stdin=subprocess.DEVNULL, capture_output=True, check=False)
    if done.returncode != 0:
        said = done.stderr.decode(errors="replace").strip().removeprefix("dmpc: ")
        raise _ERRORS.get(done.returncode, Error)(said or f"dmpc ended with status {done.returncode}")
    return done.stdout.decode()


def check_format(json, what):
    """Raises an Error for the JSON of a dmpc that means something else by its keys."""
    if json.get("format") != FORMAT:
        raise Error(f"{what} has format {json.get('format')}, expected {FORMAT}: python3-dmpc and dmpc are of different versions")
