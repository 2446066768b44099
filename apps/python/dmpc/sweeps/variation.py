"""An option that varies, and its values."""

import re

_UNITS = {"": 0, "B": 0, "KiB": 10, "MiB": 20, "GiB": 30}


class Variation:
    """Of the word that dmpc has checked: "page-size:1KiB,4KiB". The `cells` are numbers if all `values` are numbers, or sizes."""

    def __init__(self, text):
        name, _, values = text.partition(":")
        self.name, self.values = name.removeprefix("--"), [each for each in re.split(";" if ";" in values else ",", values) if each]
        found = [re.fullmatch(r"(\d{1,20})(B|[KMG]iB|)", value, re.ASCII) for value in self.values]
        self.are_numbers = all(found)
        self.unit = "bytes" if self.are_numbers and any(each[2] for each in found) else ""
        self.cells = [int(each[1]) << _UNITS[each[2]] for each in found] if self.are_numbers else self.values
