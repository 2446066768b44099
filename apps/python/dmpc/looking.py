"""What a render did, event by event: its references of pages, and its trace."""

import json
import pathlib
import tempfile

import pandas

from . import program


def _written(options, option, name):
    """The bytes that `dmpc render` writes for an option, and nothing else that it makes."""
    scene, options = program.scene_of(options)
    with tempfile.TemporaryDirectory(prefix="dmpc-") as folder:
        path = pathlib.Path(folder, name)
        program.run(["render", scene, *program.words(options), f"--{option}={path}", "--quiet", f"--output={folder}/film.png"])
        return path.read_bytes()


def references(options):
    """The pages of others that each node looked up, in order: a frame with the columns of `dmpc render --references`."""
    with tempfile.TemporaryDirectory(prefix="dmpc-") as folder:
        path = pathlib.Path(folder, "references.csv")
        path.write_bytes(_written(options, "references", "references.csv"))
        return pandas.read_csv(path)


def trace(options):
    """Events, one a row: "track" is a node or the host, "ph" what kind of event (Chrome's trace format: X a span, C a level, s and f
    the ends of a message), "ts" and "dur" microseconds; attrs["about"] says of what run, and what was left out."""
    found = json.loads(_written(options, "trace", "trace.json"))
    tracks = {event["tid"]: event["args"]["name"] for event in found["traceEvents"] if event["name"] == "thread_name"}
    events = [event for event in found["traceEvents"] if event["ph"] != "M"]
    frame = pandas.json_normalize(events)
    frame.insert(0, "track", [tracks.get(event.get("tid"), "") for event in events])
    frame.attrs = {"about": found["otherData"]}
    return frame
