"""Pictures as linear floats, row by row from the top left, and their errors."""

import itertools
import json
import math
import struct
import zlib
from array import array

from .. import program

GROUPS = 64  # of pixels, dealt by a hash: what they differ in says how far chance moves an error
_BLOCK = 16  # rows
_BITS = (1 << 64) - 1


def read_exr(path):
    """A file that dmpc wrote: channels B, G and R of floats, in blocks of rows that zlib has packed where that saved room."""
    data, at, found = path.read_bytes(), 8, {}
    while data[at]:
        name, kind, _ = data[at:at + 512].split(b"\0", 2)
        at += len(name) + len(kind) + 2
        [size] = struct.unpack_from("<i", data, at)
        found[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    left, top, right, bottom = struct.unpack("<4i", found[b"dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    floats = array("f", bytes(12 * width * height))
    for place in struct.unpack_from(f"<{-(-height // _BLOCK)}Q", data, at + 1):
        first, size = struct.unpack_from("<2i", data, place)
        rows, packed = min(_BLOCK, bottom + 1 - first), data[place + 8:place + 8 + size]
        numbers = array("f", packed if size == 12 * width * rows else _joined(zlib.decompress(packed)))
        for part in range(3 * rows):
            row, channel = divmod(part, 3)
            begin = 3 * width * (first - top + row)
            floats[begin + 2 - channel:begin + 3 * width:3] = numbers[width * part:width * (part + 1)]
    return floats


def _joined(split):
    """Undoes what EXR does before it packs: even and odd bytes apart, each as its distance from the one before."""
    summed = bytes(itertools.accumulate(split, lambda before, byte: before + byte - 128 & 255))
    whole, half = bytearray(len(summed)), (len(summed) + 1) // 2
    whole[0::2], whole[1::2] = summed[:half], summed[half:]
    return bytes(whole)


def groups_of(pixels):
    """The group of each channel of so many pixels."""
    return [group for pixel in range(pixels) for group in [_mixed(pixel) % GROUPS] * 3]


def _mixed(value):
    """core/base/sampling.h"""
    value = (value ^ value >> 30) * 0xbf58476d1ce4e5b9 & _BITS
    value = (value ^ value >> 27) * 0x94d049bb133111eb & _BITS
    return value ^ value >> 31


def square_errors(picture, mean, half_difference, groups):
    """The mean square error by group, without the reference's own error: sums of (P - A)(P - B) over channels, divided by the number of all
    channels, for a reference with the halves A and B. Both have independent errors, so the groups' sum is on average that of P alone; it
    can be below 0."""
    squares, channels = [0.0] * GROUPS, len(groups)
    for group, value, middle, off in zip(groups, picture, mean, half_difference):
        squares[group] += ((value - middle) * (value - middle) - off * off) / channels
    return squares


def difference(picture, reference):
    """The measures of dmpc compare by name; infinite ones are no JSON."""
    measured = json.loads(program.run(["compare", str(picture), str(reference), "--format=json"], passing=(5,)))
    return {name: math.inf if value is None else value for name, value in measured.items()}
