"""The common part of studies that print a table: what is said meanwhile, where the table goes, and the exit status."""

import contextlib
import os
import pathlib
import signal
import subprocess
import sys
import tempfile

from .. import program
from . import plots, table

INTERRUPTED = 130
_CLEAR = "\r\x1b[K"
_HEIR = 'read -r nothing; for n in 1 2 3 4 5 6 7 8 9; do rm -rf -- "$1"; sleep 0.2; [ -e "$1" ] || break; done'


def add_options(parser, scenes=None):
    """Those that dmpc has checked before it started this program; `scenes` says how many there are, as argparse does."""
    parser.add_argument("--format", choices=table.FORMATS, default="markdown")
    parser.add_argument("-o", "--output")
    parser.add_argument("--quiet", action="store_true")
    parser.add_argument("--plots", type=pathlib.Path)
    parser.add_argument("scene", nargs=scenes)


class NothingFits(program.CapacityError):
    """All rows are there, and none has figures."""


class Messages:
    """On stderr. Progress and rows are for a user who waits at a terminal."""

    def __init__(self, options):
        self._has_terminal = sys.stderr.isatty() and not options.quiet
        self._shows_rows = self._has_terminal and not options.output and options.format == "markdown"

    def row(self, text):
        if self._shows_rows:
            self._write(text + "\n")

    def progress(self, done, total):
        if self._has_terminal:
            self._write(f"runs: {done} of {total}" if done < total else "")

    def say(self, text):
        self._write(f"dmpc: {text}\n")

    def _write(self, text):
        sys.stderr.write((_CLEAR if self._has_terminal else "") + text)
        sys.stderr.flush()


def run(measure, rows, options, messages, closing=lambda: (), draw=lambda: None):
    """Calls measure(), which adds to the table `rows`, and writes that, whatever ended the measuring, with the closing notes; draw() makes
    the plots of the rows, if they are asked for. The exit status."""
    take_signals()
    status = 0
    try:
        if options.plots:
            plots.check()
        measure()
    except KeyboardInterrupt:
        rows.note("Interrupted: rows are missing.")
        messages.say("interrupted, " + ("the table has the rows finished before" if rows.rows else "nothing was written"))
        status = INTERRUPTED
    except program.Error as error:
        if not isinstance(error, NothingFits):
            rows.note("Ended by an error: rows are missing.")
        messages.say(error)
        status = program.status_of(error)
    if rows.rows or status == 0:
        for note in closing():
            rows.note(note)
        status = write(rows.text(options.format), options.output, messages) or status
        try:
            if options.plots:
                draw()
        except OSError as error:
            messages.say(f"--plots: {error.filename}: {error.strerror}")
            status = status or program.status_of(program.InputError())
    return status


@contextlib.contextmanager
def scratch_folder():
    """For all temporary files of this program, which go with it even if it is killed: then by a shell, which waits for its end. The path."""
    with tempfile.TemporaryDirectory(prefix="dmpc-") as folder:
        heir = subprocess.Popen(["/bin/sh", "-c", _HEIR, "dmpc-heir", folder], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL,
                                stderr=subprocess.DEVNULL, start_new_session=True)
        tempfile.tempdir = folder
        try:
            yield folder
        finally:
            tempfile.tempdir = None
            heir.kill()
            heir.communicate()


def take_signals():
    """The first one stops the measuring, a second one ends this program at once. Nobody reads any more: that is its end, too."""
    wanted = [each for each in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP) if signal.getsignal(each) != signal.SIG_IGN]

    def stop(number, frame):
        for each in wanted:
            signal.signal(each, signal.SIG_DFL)
        raise KeyboardInterrupt

    for each in wanted:
        signal.signal(each, stop)
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)


def write(text, path, messages, option="-o"):
    """To the file of an option, which is replaced at once, or to the standard output; the exit status."""
    try:
        if path is None:
            print(text, end="", flush=True)
            return 0
        target = pathlib.Path(path).resolve()
        if target.exists() and not target.is_file():
            target.write_text(text)
            return 0
        new = target.with_name(f".dmpc-next-{target.name}")
        new.write_text(text)
        os.replace(new, target)
    except OSError as error:
        where = f"{option} {path}" if path else "the table could not be written to the standard output"
        messages.say(f"{where}: {error.strerror}")
        return program.status_of(program.InputError())
    return 0
