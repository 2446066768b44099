"""A folder that keeps the counters of runs and the databases of large scenes, so that no sweep does again what another has done.

Others may have written into it: only ordinary files are read, no links followed, and what is not as it should be is made again. A file is
replaced by its name, so nothing outside is ever changed.
"""

import contextlib
import hashlib
import json
import os
import pathlib
import secrets
import stat

from .. import program

DATABASE_BYTES_MIN = 16 << 20  # a smaller one is built in the time that it takes to read it
_COUNTERS_BYTES_MAX = 128 << 20  # more than any counters have
_COMPANIONS = ("dmpc_*reader", "dmpc_policy_host", "dmpc_*.so")  # of the program: others may give other figures


class Kept:
    """KEY.json has the counters of a run, and the key is a digest of all that they depend on: the bytes of the program with its readers and
    modules, the options in any order, the bytes of files that these name, and `source`, a digest of the scene's files. SCENE-KEY.pages has
    a database. `say` is called with what becomes of those that cannot be used."""

    def __init__(self, folder, source, say):
        self._folder, self._say = pathlib.Path(folder), say
        path = pathlib.Path(program.path()).resolve()
        places = [path.parent, path.parent / "../libexec/dmpc", path.parent / "../lib/dmpc"]
        companions = [each for place in places for pattern in _COMPANIONS for each in sorted(place.glob(pattern))]
        self._common = [source.encode(), *map(_digest, [path, *companions])]
        self._databases = {}  # None for one that is small
        self._named = {}  # digests of files by their names in options: several runs name one

    def _path(self, words):
        """Of a run's counters."""
        digest = hashlib.sha256(b"\0".join(self._common))
        for word in sorted(words):
            digest.update(b"\0" + os.fsencode(word))
            named = word.partition("=")[2]
            if named.startswith("python:"):
                named = named.removeprefix("python:").rpartition(":")[0]
            if os.path.isfile(named) and os.access(named, os.R_OK):
                digest.update(self._digest_of(named))
        return self._folder / f"{digest.hexdigest()[:32]}.json"

    def _digest_of(self, named):
        if named not in self._named:
            self._named[named] = _digest(named)
        return self._named[named]

    def find(self, words):
        """The counters of a run, if there are any that can be read."""
        try:
            with open(os.open(self._path(words), os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_NOCTTY), "rb") as file:
                if stat.S_ISREG(os.fstat(file.fileno()).st_mode):
                    found = json.loads(file.read(_COUNTERS_BYTES_MAX))
                    return found if isinstance(found, dict) and found.get("format") == program.FORMAT else None
        except (OSError, ValueError, RecursionError):
            pass
        return None

    def keep(self, words, stats):
        """Raises a program.InputError if that fails."""
        with self._replacing(self._path(words)) as new, open(new, "x") as file:
            json.dump(stats, file)

    def provide(self, name, words, scene):
        """Builds the database of this name by these words, unless it is kept, or small. Raises a program.Error as dmpc build does."""
        path = self._folder / name
        if name not in self._databases and not _is_current(path):
            with self._replacing(path) as new:
                for old in self._folder.glob(name.rpartition("-")[0] + "-*.pages"):  # of what the scene was before, or odd
                    self._say(f"{old}: it is built again")
                    old.unlink()
                program.run(["build", scene, *words, "--quiet", "-o", str(new)])
                if new.stat().st_size < DATABASE_BYTES_MIN:
                    new.unlink()
                    path = None
        self._databases.setdefault(name, path)

    @contextlib.contextmanager
    def _replacing(self, path):
        """A new file, which takes this path's place unless it is gone."""
        new = self._folder / f".{secrets.token_hex(16)}{path.suffix}"
        try:
            yield new
            if new.exists():
                os.replace(new, path)
        except OSError as error:
            raise program.InputError(f"--runs={self._folder}: {error.strerror}") from error
        finally:
            new.unlink(missing_ok=True)

    def database(self, name):
        """Its path, or None if there is none."""
        return self._databases.get(name)


def _is_current(path):
    """Whether it is a database that dmpc can read, which it does only if nobody else can have written it."""
    try:
        if stat.S_ISREG(path.lstat().st_mode):
            program.run(["info", str(path), "--nodes=1", "--quiet"])
            return True
    except (OSError, program.Error):
        pass
    return False


def _digest(path):
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").digest()
