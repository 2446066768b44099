"""What a render did, event by event: its references of pages, and its trace."""

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


def _fields(message):
    """The fields of a message of Protocol Buffers, each its number with a whole number or bytes."""
    at = 0

    def number():
        nonlocal at
        value = shift = 0
        while True:
            byte = message[at]
            at += 1
            value |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                return value

    while at < len(message):
        tag = number()
        if tag & 7 == 0:
            yield tag >> 3, number()
        else:
            length = 8 if tag & 7 == 1 else number()
            yield tag >> 3, message[at:at + length]
            at += length


class _Trace:
    """The packets of a Perfetto trace as dmpc writes it (apps/frontend/show/trace/perfetto.h), taken one after the other."""

    def __init__(self):
        self.texts, self.tracks, self.open, self.rows, self.about = {}, {}, {}, [], {}

    def take(self, packet):
        packet = dict(_fields(packet))
        for of, entry in _fields(packet.get(12, b"")):
            entry = dict(_fields(entry))
            self.texts[of, entry[1]] = entry[2].decode()
        if 60 in packet:
            self._take_track(dict(_fields(packet[60])))
        if 11 in packet:
            self._take_event(packet.get(8, 0) / 1000, list(_fields(packet[11])))

    def _take_track(self, track):
        own = track.get(2, b"").decode()
        of, number = (track[3], 6) if 3 in track else (track.get(4, b""), 5)  # of a process, or a thread
        name = dict(_fields(of)).get(number, b"").decode()
        self.tracks[track[1]] = (name or self.tracks[track[5]][0], own)

    def _take_event(self, ts, fields):
        event = dict(fields)
        track, own = self.tracks[event[11]]
        row = {"track": own if track == "run" else track, "ph": {1: "W" if own and track != "run" else "X", 3: "s", 4: "C"}.get(event[9]),
               "ts": ts, "name": event[23].decode() if 23 in event else self.texts.get((2, event.get(10)), own)}
        for number, field in fields:
            if number == 4:
                argument = dict(_fields(field))
                name = argument[10].decode() if 10 in argument else self.texts[3, argument[1]]
                text = argument[6].decode() if 6 in argument else self.texts.get((29, argument.get(17)))
                row["args." + name] = text if text is not None else argument.get(3, argument.get(2))
        if event[9] == 2:
            begun = self.open[event[11]].pop()
            begun["dur"] = ts - begun["ts"]
        elif own == "run":
            self.about = {"clock": row["name"], **{key[5:]: text for key, text in row.items() if key.startswith("args.")}}
            self.open[event[11]] = [row]
        else:
            if event[9] == 1:
                self.open.setdefault(event[11], []).append(row)
            elif event[9] == 3:
                row["ph"] = "s" if 47 in event else "f"
                row["id"] = int.from_bytes(event[47] if 47 in event else event[48], "little")
            else:
                row["args.value"] = event[30]
            self.rows.append(row)


def trace(options):
    """Events, one a row: "track" is a node or the host, "ph" what kind of event (X a span, W a wait for a page, C a level, s and f the
    ends of a message, which have an "id"), "ts" and "dur" microseconds; attrs["about"] says of what run, and what was left out."""
    read = _Trace()
    for _, packet in _fields(_written(options, "trace", "trace.pftrace")):
        read.take(packet)
    frame = pandas.DataFrame(read.rows)
    frame.attrs = {"about": read.about}
    return frame
