"""Pages that `dmpc render --report` writes: the arrays that they play."""

import base64
import html.parser
import json
import pathlib

import numpy

from .program import Error, InputError

FORMAT = 3  # of the data in a page
_TYPES = {"u1": numpy.dtype("<u1"), "u2": numpy.dtype("<u2"), "u4": numpy.dtype("<u4"), "f8": numpy.dtype("<f8")}


class Page:
    """What a page plays.

    data    all of it, as the page has it, with arrays in place of texts
    share   for each of the works and waits that a node's time goes to, how much of each step: an array of nodes and steps, 0 to 1
    done    when each pixel was done, as a share of the run: an array of height and width
    fields  for each heat map what each pixel took: an array of height and width
    """

    def __init__(self, path):
        self.data = _unpacked(_data_in(path), path)
        try:
            steps, wide, high = self.data["steps"], self.data["wide"], self.data["high"]
            self.share = {work["name"]: (work["shares"] / 255).reshape(-1, steps) for work in [*self.data["works"], *self.data["waits"]]}
            self.done = self.data["done"].reshape(high, wide) / 65535
            self.fields = {field["name"]: field["values"].reshape(high, wide) * field["scale"] for field in self.data["fields"]}
        except (KeyError, TypeError, ValueError, AttributeError) as error:
            raise InputError(f"{path}: its data do not hold together ({error!r:.200}): write the page anew") from error

    @property
    def seconds(self):
        """How long the run took, in the clock that data["clock"] names."""
        return 1e-9 * self.data["total_ns"]


def page(path):
    """Reads a page. Raises an InputError for a file that is none, or of another version."""
    return Page(path)


class _Data(html.parser.HTMLParser):
    """The text of <script type="application/json" id="data">."""

    def __init__(self):
        super().__init__()
        self.is_inside, self.text = False, None

    def handle_starttag(self, tag, attrs):
        self.is_inside = tag == "script" and ("id", "data") in attrs and self.text is None

    def handle_endtag(self, tag):
        self.is_inside = False

    def handle_data(self, data):
        if self.is_inside:
            self.text = (self.text or "") + data


def _data_in(path):
    try:
        parser = _Data()
        parser.feed(pathlib.Path(path).read_text(encoding="utf-8"))
        data = json.loads(parser.text or "null")
    except (OSError, ValueError) as error:
        raise InputError(f"{path}: {error}") from error
    if not isinstance(data, dict):
        raise InputError(f"{path} has no data of a run: expected a page that dmpc render --report wrote")
    if data.get("format") != FORMAT:
        raise Error(f"{path} has data of format {data.get('format')}, expected {FORMAT}: python3-dmpc and the dmpc that wrote it are of "
                    "different versions")
    return data


def _unpacked(data, path):
    """Every {"type": ..., "data": ...} as an array."""
    if isinstance(data, list):
        return [_unpacked(each, path) for each in data]
    if not isinstance(data, dict):
        return data
    if data.keys() == {"type", "data"}:
        try:
            return numpy.frombuffer(base64.b64decode(data["data"], validate=True), _TYPES[data["type"]])
        except (KeyError, TypeError, ValueError) as error:
            raise InputError(f"{path}: an array in it cannot be read ({error!r:.200}): write the page anew") from error
    return {name: _unpacked(each, path) for name, each in data.items()}
