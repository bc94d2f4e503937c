#!/usr/bin/env python3
"""Reads a raw film with nothing but Python's own library, as docs/raw_film.md describes it, and compares
its image with the one that Duet writes.

    tests/raw_film_reader.py DUET    renders a scene both ways; exit code 1 if the images differ
"""
import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib


def read_parts(path):
    """The parts of an OpenEXR file of lines, ZIP- or RLE-compressed: attributes, lines per channel, width, sizes."""
    data = pathlib.Path(path).read_bytes()
    is_multipart, at, parts = data[5] & 0x10, 8, []

    def word():
        nonlocal at
        end = data.index(0, at)
        text, at = data[at:end].decode(), end + 1
        return text

    while data[at] or not parts:
        attributes = {}
        while name := word():
            word()
            size = struct.unpack_from("<i", data, at)[0]
            attributes[name], at = data[at + 4:at + 4 + size], at + 4 + size
        x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
        sizes = {c[:c.index(0)].decode(): 2 if c[c.index(0) + 1] == 1 else 4 for c in split_channels(attributes["channels"])}
        parts.append((attributes, {n: [None] * (y1 - y0 + 1) for n in sizes}, x1 - x0 + 1, sizes))
        if not is_multipart:
            break
    at += is_multipart != 0
    at += 8 * sum(-(-len(next(iter(p[1].values()))) // together(p[0])) for p in parts)
    while at < len(data):
        number = struct.unpack_from("<i", data, at)[0] if is_multipart else 0
        y, size = struct.unpack_from("<2i", data, at + 4 * (is_multipart != 0))
        at += 8 + 4 * (is_multipart != 0)
        attributes, lines, width, sizes = parts[number]
        count = min(together(attributes), len(next(iter(lines.values()))) - y)
        block = unpacked(data[at:at + size], width * sum(sizes.values()) * count, attributes)
        for k in range(count):
            for channel in sorted(lines):
                end = sizes[channel] * width
                lines[channel][y + k], block = block[:end], block[end:]
        at += size
    return parts


def split_channels(attribute):
    while attribute[0]:
        size = attribute.index(0) + 17
        yield attribute[:size]
        attribute = attribute[size:]


def together(attributes):
    """Lines that are compressed as one: 1 with run-length encoding, 16 with ZIP."""
    return {1: 1, 3: 16}[attributes["compression"][0]]


def runs(block):
    at = 0
    while at < len(block):
        count = block[at]
        literal = 256 - count if count > 127 else 0
        yield block[at + 1:at + 1 + literal] if literal else block[at + 1:at + 2] * (count + 1)
        at += 1 + (literal or 1)


def unpacked(block, size, attributes):
    if len(block) == size:
        return block
    block = bytearray(b"".join(runs(block)) if together(attributes) == 1 else zlib.decompress(block))
    for i in range(1, size):
        block[i] = (block[i - 1] + block[i] - 128) & 255
    half = (size + 1) // 2
    block[0::2], block[1::2] = block[:half], block[half:]
    return bytes(block)


def read_raw_film(path):
    """The image of a raw film without splats, as {(x, y): [R, G, B, ...]}, and what the film says of itself."""
    attributes, lines, _, _ = read_parts(path)[0]
    text, checksum = attributes["duetRawFilm"], zlib.crc32(attributes["duetRawFilm"])
    facts = json.loads(text)
    names = ["weight"] + facts["image"]["contents"]["channels"]
    sums = {}
    ys = [y for y0, y1 in facts["films"][0]["rows"] for y in range(y0, y1)]
    xs = [x for x0, x1 in facts["films"][0]["columns"] for x in range(x0, x1)]
    for row, y in enumerate(ys):
        words = [[lines[f"{n}.{k}"][row] for k in range(4)] for n in names]
        for column, x in enumerate(xs):
            own = [b"".join(w[4 * column:4 * column + 4] for w in ws) for ws in words]
            checksum = zlib.crc32(b"".join(own), checksum)
            pixel = sums.setdefault((x, y), [0] * len(names))
            for i, integer in enumerate(own):
                pixel[i] += int.from_bytes(integer, "little", signed=True)
    assert f"{checksum:08x}" == attributes["duetRawFilmChecksum"].decode()[9:], "checksum"
    return {at: [s / p[0] for s in p[1:]] for at, p in sums.items()}, facts


def main(duet):
    scene = pathlib.Path(__file__).parent.parent / "scenes/cornell-box/scene.xml"
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([duet, str(scene), "--size", "37x21", "--spp", "4", "-i", "path", "-q", "--raw", "raw.exr", "-o", "image.exr",
                        "--aov", "position"], cwd=folder, check=True)
        pixels, facts = read_raw_film(f"{folder}/raw.exr")
        _, lines, _, sizes = read_parts(f"{folder}/image.exr")[0]
        assert facts["state"]["samples"] == [[0, 4]] and len(pixels) == 37 * 21
        channels = facts["image"]["contents"]["channels"]
        worst = 0
        for name in channels:
            for (x, y), values in pixels.items() if name in lines else ():
                form = "<e" if sizes[name] == 2 else "<f"
                expected = struct.unpack_from(form, lines[name][y], sizes[name] * x)[0]
                # A half float has 11 bits.
                scale = 2**-11 if sizes[name] == 2 else 2**-24
                worst = max(worst, abs(values[channels.index(name)] - expected) / scale / max(1, abs(expected)))
        print(f"the image differs by at most {worst:.2g} of a last bit")
        return worst > 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
