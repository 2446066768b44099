"""The scene of the study and its runs, as systems have them."""

import functools

from ..studies import runs, subject
from ..studies.judging import priced_for
from .setups import Database

_OWN = "own"  # the name of a machine's file among drawn machines


def figures(stats):
    """What is kept of a run."""
    options, rays, packets = stats["options"], stats["rays"]["total"], stats["packets"]
    return {"seconds": stats["virtual_seconds"]["total"], "memory": options["node_memory"],
            "in-flight": options["in_flight"], "ray-batch": options["ray_batch"], "host": _host_busy(stats),
            "share": {part: stats["time_percent"][part] for part in runs.PARTS},
            "messages": packets["sent"] / rays if rays else 0.0, "bytes": packets["bytes"] / rays if rays else 0.0}


def _host_busy(stats):
    """The share of the run in which the host computes, sends, receives or serves pages."""
    host, total = stats["host"]["virtual_seconds"], stats["virtual_seconds"]["total"]
    busy = ("computing", "sending", "receiving", "service_busy", "service_idle")
    return sum(host[part] for part in busy) / total if host and total else 0.0


class Subject(subject.Subject):
    def __init__(self, scene, picture, machine, folder, messages):
        self._files, self._structures = {_OWN: machine} if machine.endswith(".json") else {}, set()
        super().__init__(scene, picture, machine, folder, messages, figures, machines=self._files)
        self._name(Database())

    def _name(self, asked):
        self.databases[asked.name] = asked.words
        return asked.name

    def line(self, setup, draw=None):
        """The command of a run, on the machine or on one whose prices are drawn."""
        machine = priced_for(self.machine, setup.database.structure)
        if machine == self.machine:
            self._structures.add(setup.database.structure)
        if draw is not None:
            machine = f"machines/{_OWN if self._files else machine}.{draw}.json"
        return super().line(self._name(setup.database), setup.words, machine)

    @functools.cache
    def database(self, asked):
        return super().database(self._name(asked))

    @property
    def machine_name(self):
        return self.asked["machine"]["name"]

    def prices_of(self, structure):
        """The name of the machine whose prices runs on this structure have."""
        priced = priced_for(self.machine, structure)
        return self.machine_name if priced == self.machine else priced

    def price_notes(self):
        return subject.price_notes(self.asked["machine"], self._structures)
