#!/usr/bin/env python3
"""Measures the memory and the time that large scenes take, against what `duet info` announces.

    memory.py --duet build/duet [--work FOLDER] [NAME...]

The scenes are generated: `triangles`, 20 million of one binary PLY file; `instances`, 100 million by 20,000 instances
of 1,000 meshes; `bitmaps`, 4 GB of PNG files with noise in them; `lamp`, 2 million triangles that emit. Each is rendered
with one sample at 512×512 by `path`. With --work the files stay for the next call. Needs numpy.
"""
import argparse
import json
import random
import struct
import subprocess
import tempfile
import time
import zlib
from pathlib import Path

import numpy as np

from make_big_mesh import torus, write_ply

SENSOR = """<integrator type="path"/><sensor type="perspective"><float name="fov" value="45"/>
<transform name="to_world"><lookat origin="{}" target="{}" up="0,0,1"/></transform>
<film type="hdrfilm"><integer name="width" value="512"/><integer name="height" value="512"/></film></sensor>
"""


def write_scene(folder, body, origin="0,-4,2", target="0,0,0"):
    path = folder / "scene.xml"
    path.write_text(f'<scene version="3.0.0">{SENSOR.format(origin, target)}{body}</scene>')
    return path


def ply(name, inner=""):
    return f'<shape type="ply"><string name="filename" value="{name}"/>{inner}</shape>'


def triangles(folder):
    p, _, faces = torus(20_000_000)
    write_ply(folder / "mesh.ply", p, None, faces)
    return write_scene(folder, '<emitter type="constant"/>' + ply("mesh.ply"))


def lamp(folder):
    p, n, faces = torus(2_000_000)
    write_ply(folder / "mesh.ply", p, n, faces)
    return write_scene(folder, ply("mesh.ply", '<emitter type="area"/>'))


def instances(folder):
    numbers = random.Random(1)
    body = ['<emitter type="constant"/>']
    for i in range(1000):
        p, n, faces = torus(5000)
        write_ply(folder / f"{i}.ply", p * (0.5 + numbers.random() / 2), n, faces)
        body.append(f'<shape type="shapegroup" id="g{i}">{ply(f"{i}.ply")}</shape>')
    for i in range(20_000):
        body.append(f'<shape type="instance"><ref id="g{i % 1000}"/><transform name="to_world">'
                    f'<rotate z="1" angle="{360 * numbers.random():.4f}"/>'
                    f'<translate x="{i % 141}" y="{i // 141}"/></transform></shape>')
    return write_scene(folder, "\n".join(body), "-10,-10,60", "70,70,0")


def write_png(path, rows):
    """Rows of 8-bit RGB, height × width × 3, without compression."""
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    height, width, _ = rows.shape
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)))
        packer = zlib.compressobj(0)
        for first in range(0, height, 256):
            part = rows[first:first + 256].reshape(-1, 3 * width)
            filtered = np.hstack([np.zeros((len(part), 1), np.uint8), part]).tobytes()
            file.write(chunk(b"IDAT", packer.compress(filtered)))
        file.write(chunk(b"IDAT", packer.flush()) + chunk(b"IEND", b""))


def bitmaps(folder):
    numbers = np.random.default_rng(1)
    body = ['<emitter type="constant"/>']
    for i in range(8):
        write_png(folder / f"{i}.png", numbers.integers(0, 256, (13_000, 13_000, 3), np.uint8))
        body.append(f'<shape type="sphere"><point name="center" x="{i - 3.5}" y="0" z="0"/>'
                    '<float name="radius" value="0.5"/><bsdf type="diffuse"><texture type="bitmap" name="reflectance">'
                    f'<string name="filename" value="{i}.png"/></texture></bsdf></shape>')
    return write_scene(folder, "".join(body), "0,-10,2")


SCENES = {f.__name__: f for f in (triangles, instances, bitmaps, lamp)}


def measure(duet, name, work):
    folder = work / name
    scene = folder / "scene.xml"
    if not scene.exists():
        folder.mkdir(parents=True, exist_ok=True)
        SCENES[name](folder)
    info = json.loads(subprocess.run([duet, "info", "--json", scene], check=True, capture_output=True).stdout)
    start = time.monotonic()
    subprocess.run([duet, "render", scene, "--spp", "1", "-q", "-o", folder / "image.exr",
                    "--stats", folder / "stats.json"], check=True)
    seconds = time.monotonic() - start
    peak = json.loads((folder / "stats.json").read_text())["memory_peak_bytes"]
    count = info["shapes"]["triangles"]
    print(f"| `{name}` | {count:,} | {info['shapes']['triangles_in_all_copies']:,.0f} | "
          f"{info['memory']['total'] / 1e9:.2f} GB | {peak / 1e9:.2f} GB | "
          f"{f'{peak / count:.0f}' if count else ''} | {seconds:.1f} s |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--duet", required=True, type=Path)
    parser.add_argument("--work", type=Path)
    arguments = parser.parse_args()
    unknown = set(arguments.names) - set(SCENES)
    if unknown:
        parser.error(f"there is no scene {sorted(unknown)[0]}; there are {', '.join(SCENES)}")
    print("| scene | triangles | in all copies | announced | peak | bytes a triangle | whole process |\n"
          "|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as temporary:
        for name in arguments.names or SCENES:
            measure(arguments.duet.resolve(), name, arguments.work or Path(temporary))


if __name__ == "__main__":
    main()
