"""Pictures as arrays, by OpenImageIO."""

import pathlib
import tempfile

import numpy
import OpenImageIO

from .program import Error


def read(path):
    """Heights, widths and channels of floats."""
    file = OpenImageIO.ImageInput.open(str(path))
    if file is None:
        raise Error(f"{path}: {OpenImageIO.geterror()}")
    pixels = file.read_image("float")
    file.close()
    if pixels is None:
        raise Error(f"{path}: {file.geterror()}")
    return numpy.asarray(pixels)


def srgb(linear):
    """Bytes for a screen, of linear floats (IEC 61966-2-1)."""
    light = numpy.clip(numpy.nan_to_num(linear), 0, 1)
    curved = numpy.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
    return (255 * curved + 0.5).astype(numpy.uint8)


def png(pixels):
    """A PNG file of bytes in three channels, as bytes."""
    height, width, channels = pixels.shape
    with tempfile.TemporaryDirectory(prefix="dmpc-") as folder:
        path = pathlib.Path(folder, "picture.png")
        file = OpenImageIO.ImageOutput.create(str(path))
        if not (file.open(str(path), OpenImageIO.ImageSpec(width, height, channels, "uint8")) and file.write_image(pixels)):
            raise Error(f"{path}: {file.geterror()}")
        file.close()
        return path.read_bytes()
