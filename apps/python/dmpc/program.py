"""The program dmpc: found, called, and what it says when it fails."""

import ctypes
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile

from .commas import WITH_COMMAS

FORMAT = 2  # of its JSON files
Text = str | int | float | os.PathLike  # what is typed as it is


class Error(Exception):
    """dmpc did not do what it was asked for; the message is its own."""


class InputError(Error):
    """Bad input, or an output that cannot be written."""


class UsageError(Error):
    """Options that there are none, or that do not go together."""


class InternalError(Error):
    """An error of dmpc's own."""


class CapacityError(Error):
    """There is no room, on this computer or in the nodes' memory: the message says what would do."""


_ERRORS = {1: InputError, 2: UsageError, 3: InternalError, 4: CapacityError}


def status_of(error):
    """The exit status by which dmpc tells such an error."""
    return next((status for status, kind in _ERRORS.items() if isinstance(error, kind)), 1)


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
    return hasattr(plain(value), "__iter__") and not isinstance(value, (str, bytes, os.PathLike))


def several(value):
    return [plain(each) for each in value] if is_several(value) else [plain(value)]


def plain(value):
    """numpy's scalars as Python's: its False is none, but == False."""
    return value.item() if hasattr(value, "item") and getattr(value, "ndim", 0) == 0 else value


def scene_of(options):
    """Takes the scene out of what a call was given, and what is None or False. Raises a UsageError for what would be an option in a
    scene's place."""
    given = {name: plain(value) for name, value in options.items()}
    given = {name: value for name, value in given.items() if value is not None and value is not False}
    scene = str(given.pop("scene", ""))
    if not scene or scene.startswith("-"):
        raise UsageError(f"{scene or 'no scene'}: expected a scene's name or file; options are named arguments, such as nodes=8")
    return scene, given


def words(options):
    """Options as dmpc's words: node_memory="4MiB" is --node-memory=4MiB, True a flag, a list several times the option, or once with
    commas between."""
    line = []
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        values = several(value)
        if name in WITH_COMMAS and len(values) > 1:
            values = [",".join(map(str, values))]
        for each in values:
            if each is True:
                line.append(option)
            elif each is not None and each is not False:
                line.append(f"{option}={each}")
    return line


_PR_SET_PDEATHSIG = 1
_prctl = getattr(ctypes.CDLL(None), "prctl", None)  # none but on Linux


def _end_with(parent):
    """What the child is to do first, so that a Python that is killed leaves no dmpc behind."""
    def end_with_parent():
        if _prctl is not None:
            _prctl(_PR_SET_PDEATHSIG, signal.SIGTERM)
            if os.getppid() != parent:  # it has ended meanwhile
                os._exit(0)
    return end_with_parent


_TIMEOUT_SECONDS = 10  # for dmpc to end on an interruption; it cleans up what it has begun


_running = set()  # dmpc's that this Python waits for


def end_all():
    """Interrupts those that other threads wait for, which get an Error."""
    for process in list(_running):
        process.send_signal(signal.SIGINT)


def _interrupt(process):
    """Ends dmpc as Ctrl-C does, so that it takes its own children and scratch files with it; a second Ctrl-C ends it at once."""
    process.send_signal(signal.SIGINT)
    try:
        process.communicate(timeout=_TIMEOUT_SECONDS)
    finally:
        if process.poll() is None:
            process.kill()
            process.communicate()


def run(line, passing=(), noted=lambda sentence: None):
    """What dmpc prints. Raises an Error with what it says on stderr, unless it ends with a status of `passing`; `noted` is called with
    each note that it makes there nevertheless. An exception, such as KeyboardInterrupt, ends dmpc before it goes on."""
    process = subprocess.Popen([path(), *line], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                               start_new_session=True, preexec_fn=_end_with(os.getpid()))
    _running.add(process)
    try:
        output, errors = process.communicate()
    except BaseException:
        try:
            _interrupt(process)
        except subprocess.TimeoutExpired:
            pass
        raise
    finally:
        _running.discard(process)
    if process.returncode == -signal.SIGKILL:
        raise CapacityError("this computer has no memory to spare, it seems: dmpc was killed")
    if process.returncode != 0 and process.returncode not in passing:
        said = errors.decode(errors="replace").strip().removeprefix("dmpc: ")
        raise _ERRORS.get(process.returncode, Error)(said or f"dmpc ended with status {process.returncode}")
    for sentence in errors.decode(errors="replace").splitlines():
        noted(sentence.removeprefix("dmpc: "))
    return output.decode()


def counters(line, noted=lambda sentence: None):
    """The counters of a render by this line, whose picture nobody wants; a list of each frame's, if it has frames. Calls `noted` and raises
    as run() does."""
    are_frames = any(word.startswith("--frames=") for word in line)
    name = "%06d" if are_frames else "film"
    with tempfile.TemporaryDirectory(prefix="dmpc-") as folder:
        run([*line, f"--stats={folder}/{name}.json", f"--output={folder}/{name}.png"], noted=noted)
        found = [json.loads(path.read_bytes()) for path in sorted(pathlib.Path(folder).glob("*.json"))]
    return found if are_frames else found[0]


def check_format(json, what):
    """Raises an Error for the JSON of a dmpc that means something else by its keys."""
    if json.get("format") != FORMAT:
        raise Error(f"{what} has format {json.get('format')}, expected {FORMAT}: python3-dmpc and dmpc are of different versions")
