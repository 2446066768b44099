"""Runs of dmpc, each kept by its command line: what was run once is never run again."""

import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import threading

from .. import program

CORES = len(os.sched_getaffinity(0))
# The parts of the nodes' time, as keys of the counters.
PARTS = ("computing", "data_wait", "starvation", "token_wait", "credit_wait", "film_wait", "other_wait", "service_busy", "service_idle",
         "messages", "idle_at_end")
_OF_THIS_COMPUTER = "this computer has "  # begins what is said where the nodes' memory is not what lacks


class Runs:
    """The folder of a study: `runs.jsonl` has a line for each run, written when it ends; `databases` and `machines` have what several runs
    share, which lines name as databases/NAME.pages and machines/MACHINE.DRAW.json.

    `jobs` runs go side by side. `figures` returns what is kept of the counters of one, `database` the words by which dmpc builds the
    database of a name. `say` is called with what dmpc notes of a scene, `progress` with the runs that have ended and all that were asked
    for together.
    `machines` has the files of machines that are no presets, by their names in lines.
    """

    def __init__(self, folder, jobs, figures, database, say=lambda text: None, progress=lambda done, total: None, machines={}):
        self.folder, self.jobs, self.say, self._progress = pathlib.Path(folder).absolute(), jobs, say, progress
        self._figures, self._database, self._machines = figures, database, machines
        self._kept, self._lock, self._noted = {}, threading.Lock(), set()
        for name in ("machines", "databases"):
            (self.folder / name).mkdir(parents=True, exist_ok=True)
        if self._file.exists():
            for line in self._file.read_text().splitlines():
                try:
                    one = json.loads(line)
                except json.JSONDecodeError:
                    continue  # the line that was being written when the study was stopped
                self._kept[one["line"]] = one

    @property
    def _file(self):
        return self.folder / "runs.jsonl"

    def __len__(self):
        return len(self._kept)

    def all(self):
        return self._kept.values()

    def kept(self, line):
        return self._kept.get(line)

    def get(self, lines):
        """The results that each() yields."""
        return list(self.each(lines))

    def each(self, lines):
        """Yields the results of these command lines, in their order, as soon as they are there; those that are missing are run side by
        side. A result has the line, figures, and as "notes" what had to be reduced to fit, or the reason why there was no room in the nodes
        as "misfit". Raises in its place a program.Error with what else dmpc says; an exception, such as KeyboardInterrupt, ends the runs
        before it goes on."""
        missing = {line for line in lines if line not in self._kept}
        for line in missing:
            self._prepare(line)
        fresh = side_by_side(self._run, [line for line in dict.fromkeys(lines) if line in missing], self.jobs, self._progress)
        for line in lines:
            if line in missing:
                missing.discard(line)
                yield next(fresh)
            else:
                yield self._kept[line]

    def database(self, name):
        """The path of the database of this name, which is built if there is none."""
        path = self.folder / "databases" / f"{name}.pages"
        if not path.exists():
            program.run(["build", *self._database(name), "-o", str(path)], noted=self._note)
        return path

    def _note(self, sentence):
        """Says what dmpc notes of a scene, once."""
        if sentence not in self._noted:
            self._noted.add(sentence)
            self.say(sentence)

    def _prepare(self, line):
        if found := re.search(r"--machine=machines/(\S+)\.(\d+)\.json", line):
            path = self.folder / "machines" / f"{found[1]}.{found[2]}.json"
            if not path.exists():
                path.write_text(program.run(["machine", self._machines.get(found[1], found[1]), f"--draw={found[2]}"]))
        if found := re.match(r"render databases/(\S+)\.pages ", line):
            self.database(found[1])

    def _run(self, line):
        words = [str(self.folder / word) if word.startswith("databases/") else
                 word.replace("=machines/", f"={self.folder}/machines/") for word in shlex.split(line)]
        notes = []
        try:
            one = {"line": line, **self._figures(program.counters(words, notes.append))}
        except program.CapacityError as error:
            why = reason_of(error)
            if why.startswith(_OF_THIS_COMPUTER):
                raise
            one = {"line": line, "misfit": why}
        if reduced := [note for note in notes if " reduced from " in note]:
            one["notes"] = reduced
        with self._lock:
            self._kept[line] = one
            with open(self._file, "a") as file:
                file.write(json.dumps(one) + "\n")
        return one


def side_by_side(work, items, jobs, progress):
    """Yields what work() returns for each, in their order, as soon as it is there; `jobs` at a time. An exception, such as KeyboardInterrupt,
    ends the runs before it goes on."""
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        results, position = [pool.submit(work, item) for item in items], 0
        try:
            for count, _ in enumerate(concurrent.futures.as_completed(results), 1):
                progress(count, len(results))
                while position < len(results) and results[position].done():
                    yield results[position].result()
                    position += 1
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            program.end_all()
            raise


def at(tree, path):
    """The value below these keys, one in the other."""
    for key in path:
        tree = tree[key]
    return tree


def line_of(words):
    """A command line as it is kept: words that have blanks or marks are quoted as a shell wants them."""
    return shlex.join(words)


def reason_of(error):
    """Of a CapacityError, as part of a sentence: what dmpc says last, below its notes."""
    return str(error).splitlines()[-1].removeprefix("dmpc: ").rstrip(".")


def seconds_of(result):
    """Infinite if there was no room."""
    return result.get("seconds", float("inf"))
