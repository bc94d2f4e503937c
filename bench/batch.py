#!/usr/bin/env python3
"""Measures `duet batch` on many small jobs: how busy the processors are, what memory the parent takes, and that a second
run renders nothing but what failed.

    bench/batch.py build/duet [--jobs 1000] [--size 64x64] [--spp 4]

The jobs are as many seeds of 20 scenes of scenes/ as are needed, and three scenes that cannot be read. Before the
second run these are repaired. "busy" is the processor time of all processes, start and end of each included, over the
elapsed time of all processors, reports included; "occupied" is the time that processes of jobs were there, times their
threads, over the same time without reports. On a machine that does nothing else both are to be above 90 %; where others
compute at the same time, "busy" is what they leave, and "occupied" is what it would be otherwise.
"""
import argparse
import collections
import csv
import os
import pathlib
import resource
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENES = ["box-point", "box-spheres", "bsdf-conductors", "bsdf-dielectrics", "bsdf-plastics", "bsdf-principled",
          "camera", "cornell-box", "depth-of-field", "directional-area", "door-ajar", "glossy-kitchen", "hide-emitters",
          "instances", "lamp-in-glass", "lights-area", "lights-delta", "many-lights", "media-homogeneous", "orthographic"]
BROKEN = {"truncated": '<scene version="3.0.0"><sensor type="perspective">',
          "unknown": '<scene version="3.0.0"><sensor type="perspective"/><shape type="dodecahedron"/></scene>',
          "mesh": '<scene version="3.0.0"><sensor type="perspective"/><shape type="ply">'
                  '<string name="filename" value="nowhere.ply"/></shape></scene>'}
REPAIRED = ('<scene version="3.0.0"><sensor type="perspective"/><shape type="sphere"><emitter type="area"/></shape>'
            "</scene>")


def peak_memory(process):
    """The process's own peak in bytes, as far as it has come."""
    try:
        for line in pathlib.Path(f"/proc/{process.pid}/status").read_text().splitlines():
            if line.startswith("VmHWM:"):
                return 1024 * int(line.split()[1])
    except (FileNotFoundError, ProcessLookupError):
        pass
    return 0


def write_jobs(folder, count):
    """A manifest with `count` jobs, three of which are broken and stand in the first, second and last third."""
    for name, text in BROKEN.items():
        (folder / f"{name}.xml").write_text(text)
    rows = [(ROOT / "scenes" / SCENES[i % len(SCENES)] / "scene.xml", f"out/{i}.exr", i) for i in range(count - 3)]
    for i, name in enumerate(BROKEN):
        rows.insert(count * (2 * i + 1) // 6, (folder / f"{name}.xml", f"out/{name}.exr", 0))
    with open(folder / "jobs.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["scene", "output", "seed"])
        writer.writerows(rows)


def run(duet, folder, size, spp):
    """Runs the batch and returns what is known of it."""
    command = [duet, "batch", "jobs.csv", "--csv", "out.csv", "--junit", "junit.xml", "--report", "report.html",
               "--progress", "none", "--", "--size", size, "--spp", str(spp)]
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    process = subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    peak, rendered_at = 0, None
    while process.poll() is None:
        peak = max(peak, peak_memory(process))
        if rendered_at is None and (folder / "out.csv").exists():
            rendered_at = time.monotonic()
        time.sleep(0.02)
    wall = time.monotonic() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    with open(folder / "out.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    (folder / "out.csv").unlink()
    processors = len(os.sched_getaffinity(0))
    reports = start + wall - rendered_at if rendered_at else 0
    occupied = sum(float(row["seconds"]) * int(row["threads"]) for row in rows)
    return {"code": process.returncode, "wall": wall, "busy": cpu / (wall * processors), "peak": peak,
            "reports": reports, "occupied": occupied / ((wall - reports) * processors),
            "statuses": dict(collections.Counter(row["status"] for row in rows)),
            "failed": sorted(pathlib.Path(row["scene"]).stem for row in rows if row["status"] == "failed")}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("duet", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("--jobs", type=int, default=1000)
    parser.add_argument("--size", default="64x64")
    parser.add_argument("--spp", type=int, default=4)
    options = parser.parse_args()
    for count in (options.jobs // 10, options.jobs):
        with tempfile.TemporaryDirectory(prefix="duet-batch-") as name:
            folder = pathlib.Path(name)
            write_jobs(folder, count)
            for text in ("first", "second"):
                r = run(options.duet, folder, options.size, options.spp)
                print(f"{count} jobs, {text} run: {r['wall']:.1f} s, {100 * r['busy']:.1f} % busy, "
                      f"{100 * r['occupied']:.1f} % occupied, parent's peak {r['peak'] / 1e6:.1f} MB, reports {r['reports']:.1f} s, exit code {r['code']}, {r['statuses']}, "
                      f"failed: {r['failed']}", flush=True)
                for broken in BROKEN:
                    (folder / f"{broken}.xml").write_text(REPAIRED)


if __name__ == "__main__":
    main()
