#!/usr/bin/env python3
"""Duet against Mitsuba 3 on the same scenes, interleaved in one run.

    peers.py [--integrator path] [--rounds 5] [--spp 64] [--threads 2] [--references DIR] [--reference-spp 2048]
             [--json FILE] [SCENE...]

A SCENE is a scene file for both, or DUET_FILE,MITSUBA_FILE where the two need different files, with an
optional :WIDTHxHEIGHT. The default is the two 512² scenes of the project that have no caustics.

Each round runs, one after the other, as whole processes with the given number of threads:

    duet --strict-sampler    Duet with independent samples, as Mitsuba uses
    duet                     Duet as users get it
    scalar_rgb, llvm_ad_rgb  Mitsuba's variants

and takes user + system CPU seconds of each process and the error of its image against a converged
reference, which is made with Mitsuba (and kept in --references). Printed are medians over the rounds of
the CPU seconds, of the ratios within a round, and of the efficiency 1 / (trimmed relMSE × CPU s), where
relMSE = mean of (a − b)² / (b² + 0.01) without the worst 0.1 % of the pixels. Needs mitsuba and numpy.

    peers.py --per-sample 8 …

takes instead what one more sample takes, start-up apart: the CPU microseconds per sample of a pixel between 8 and --spp
samples per pixel, of the first and the last of these in turn, and prints the least of the rounds and their ratios.
"""
import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import mitsuba as mi
import numpy as np

mi.set_variant('llvm_ad_rgb')
mi.set_log_level(mi.LogLevel.Error)

ROOT = Path(__file__).resolve().parent.parent
RENDER_WITH_MITSUBA = str(ROOT / 'bench/mitsuba_render.py')
REFERENCE_PASS_SPP = 256


def read(path):
    bitmap = mi.Bitmap(str(path)).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False)
    return np.array(bitmap, dtype=np.float64)


def reference_image(scene, size, args):
    cached = args.references / f'{scene.parent.name}-{scene.stem}-{size[0]}x{size[1]}-{args.reference_spp}.npy'
    if cached.exists():
        return np.load(cached)
    loaded = mi.load_file(str(scene))
    parameters = mi.traverse(loaded.sensors()[0])
    parameters['film.size'] = mi.ScalarVector2u(*size)
    parameters.update()
    passes = max(1, args.reference_spp // REFERENCE_PASS_SPP)
    total = sum(np.array(mi.render(loaded, spp=REFERENCE_PASS_SPP, seed=5000 + i))[..., :3].astype(np.float64)
                for i in range(passes))
    cached.parent.mkdir(parents=True, exist_ok=True)
    np.save(cached, total / passes)
    return total / passes


def trimmed_relmse(image, reference):
    error = np.sort(((image - reference) ** 2 / (reference ** 2 + 0.01)).mean(axis=2).ravel())
    return error[:int(len(error) * 0.999)].mean()


def cpu_seconds(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def commands(args, scene, mitsuba_scene, size, out, seed, spp):
    width, height = map(str, size)
    ours = [args.duet, 'render', str(scene), '-o', out, '--spp', str(spp), '--seed', str(seed), '-q',
            '--size', f'{width}x{height}', '-t', str(args.threads), '-i', args.integrator]
    theirs = lambda variant: [sys.executable, RENDER_WITH_MITSUBA, variant, str(mitsuba_scene), out,
                              str(spp), str(seed), width, height, str(args.threads)]
    return {'duet-independent': ours + ['--strict-sampler'], 'duet': ours,
            'llvm_ad_rgb': theirs('llvm_ad_rgb'), 'scalar_rgb': theirs('scalar_rgb')}


def bench(name, scene, mitsuba_scene, size, args):
    reference = reference_image(mitsuba_scene, size, args)
    runs = {}
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, 'image.exr')
        for seed in range(1, args.rounds + 1):
            for label, command in commands(args, scene, mitsuba_scene, size, out, seed, args.spp).items():
                seconds = cpu_seconds(command)
                runs.setdefault(label, []).append((seconds, trimmed_relmse(read(out), reference)))
    median = statistics.median
    print(f'\n{name}, {size[0]}x{size[1]}, {args.spp} spp, {args.threads} threads, {args.rounds} rounds')
    print(f'{"":18} CPU s   trimmed    efficiency')
    result = {'scene': name, 'cpu': {}, 'relmse': {}, 'efficiency': {}, 'cpu_ratio': {}, 'efficiency_ratio': {}}
    for label, values in runs.items():
        result['cpu'][label] = median(s for s, _ in values)
        result['relmse'][label] = median(e for _, e in values)
        result['efficiency'][label] = median(1 / (s * e) for s, e in values)
        print(f'{label:18} {result["cpu"][label]:6.2f}  {result["relmse"][label]:.6f}  '
              f'{result["efficiency"][label]:9.2f}')
    for peer in ('scalar_rgb', 'llvm_ad_rgb'):
        result['cpu_ratio'][peer] = median(a[0] / b[0] for a, b in zip(runs['duet-independent'], runs[peer]))
        result['efficiency_ratio'][peer] = median(
            (b[0] * b[1]) / (a[0] * a[1]) for a, b in zip(runs['duet'], runs[peer]))
        print(f'CPU of duet-independent / {peer}: {result["cpu_ratio"][peer]:.3f};  '
              f'efficiency of duet / {peer}: {result["efficiency_ratio"][peer]:.2f}', flush=True)
    return result


def per_sample(name, scene, mitsuba_scene, size, args):
    further = (args.spp - args.per_sample) * size[0] * size[1] / 1e6
    slopes = {'duet-independent': [], 'llvm_ad_rgb': []}
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, 'image.exr')
        for seed in range(1, args.rounds + 1):
            for label, of_rounds in slopes.items():
                few, many = (cpu_seconds(commands(args, scene, mitsuba_scene, size, out, seed, spp)[label])
                             for spp in (args.per_sample, args.spp))
                of_rounds.append((many - few) / further)
    ours, theirs = slopes.values()
    ratios = ', '.join(f'{a / b:.2f}' for a, b in zip(ours, theirs))
    print(f'{name}, {size[0]}x{size[1]}: {min(ours):.3f} µs against {min(theirs):.3f} µs, ratio '
          f'{min(ours) / min(theirs):.2f} (rounds: {ratios})', flush=True)
    return {'scene': name, 'microseconds': slopes}


def parse_scene(text):
    files, _, size = text.partition(':')
    first, _, second = files.partition(',')
    width, height = map(int, size.split('x')) if size else (512, 512)
    path = Path(first).resolve()
    return path.parent.name, path, Path(second or first).resolve(), (width, height)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('scenes', nargs='*', default=[str(ROOT / 'scenes' / s / 'scene.xml')
                                                      for s in ('thesis-empty', 'mesh-lumpy')])
    parser.add_argument('--integrator', default='path', help='of Duet; Mitsuba uses that of its file')
    parser.add_argument('--rounds', type=int, default=5)
    parser.add_argument('--spp', type=int, default=64)
    parser.add_argument('--threads', type=int, default=2)
    parser.add_argument('--references', type=Path, default=Path(tempfile.gettempdir()) / 'duet-references')
    parser.add_argument('--reference-spp', type=int, default=2048)
    parser.add_argument('--duet', default=str(ROOT / 'build' / 'duet'))
    parser.add_argument('--per-sample', type=int, metavar='FEW')
    parser.add_argument('--json', type=Path)
    args = parser.parse_args()
    measure = per_sample if args.per_sample else bench
    results = [measure(*parse_scene(scene), args) for scene in args.scenes]
    if args.json:
        args.json.write_text(json.dumps(results, indent=1) + '\n')


if __name__ == '__main__':
    main()
