"""How much memory each node of a comparison has: a size, a share of the database, or what rays need."""

import re
from dataclasses import dataclass

from .. import program

_UNITS = {"": 0, "B": 0, "KiB": 10, "MiB": 20, "GiB": 30}
_BYTES = 1 << 40  # at most
_SHARE = 10  # of the database, at most


@dataclass(frozen=True)
class MemoryRule:
    """With neither set: what the better system with rays needs."""
    share: float | None = None
    bytes: int | None = None

    @property
    def is_of_rays(self):
        return self.share is None and self.bytes is None

    def __str__(self):
        """As on the command line: rays, 25%, 1MiB."""
        if self.bytes is not None:
            unit = next((unit for unit in ("GiB", "MiB", "KiB") if self.bytes and self.bytes % (1 << _UNITS[unit]) == 0), "B")
            return f"{self.bytes >> _UNITS[unit]}{unit}"
        return "rays" if self.share is None else f"{self.share / 0.01:g}%"

    def bytes_of(self, database_bytes, rays_bytes):
        """Of a node: all that it stores."""
        return self.bytes if self.bytes is not None else int(self.share * database_bytes) if self.share is not None else rays_bytes


def parse(text):
    """The rules of "rays,25%,1MiB". Raises a program.UsageError for anything else."""
    return [_parse_one(word) for word in text.split(",")]


def _parse_one(word):
    if word == "rays":
        return MemoryRule()
    if re.fullmatch(r"\d+(\.\d*)?%", word):
        share = 0.01 * float(word[:-1])
        if not 0 < share <= _SHARE:
            raise program.UsageError(f"--node-memory={word}: expected more than 0% and at most 1000%")
        return MemoryRule(share)
    size = re.fullmatch(r"(\d+)(B|KiB|MiB|GiB|)", word)
    if not size:
        raise program.UsageError(f"--node-memory={word}: expected rays, a share such as 25%, or a size such as 4096B, 300KiB, 4MiB or 1GiB")
    count = int(size[1]) << _UNITS[size[2]]
    if count > _BYTES:
        raise program.UsageError(f"--node-memory={word}: expected at most 1024GiB")
    return MemoryRule(bytes=count)
