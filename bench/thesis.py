#!/usr/bin/env python3
"""The thesis's two tables again: the boxes of scenes/thesis-* with every method, its time, error and bias.

    thesis.py [--iterations N] [--size 512] [--rounds 16] [--threads 2] [--duet PATH] [--folder DIR] [--quick]

Each of --rounds rounds renders both boxes at the size of the reference with every method, 64 iterations and a
new seed. These independent images show bias and error, and the median of the rounds' ratios is that of the
times (user + system CPU seconds of a process). Then the boxes are rendered as in the thesis (--size; 100 and
200 iterations unless --iterations says otherwise) for the pictures, with their times. The tables replace those
between <!-- NAME --> and <!-- end --> in docs/thesis.md; the pictures are docs/images/thesis-*.png. --folder
keeps all images, and a run that was interrupted goes on with what is there. --quick (4 rounds) prints the tables
and writes nothing. Needs numpy, the Python package (docs/python.md) and mitsuba, which reads and writes the images.
"""
import argparse
import json
import re
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import mitsuba as mi
import numpy as np

from unbiased import Reference, judge, trimmed_relmse

mi.set_variant('scalar_rgb')

ROOT = Path(__file__).resolve().parent.parent
PAGE, IMAGES = ROOT / 'docs' / 'thesis.md', ROOT / 'docs' / 'images'
REFERENCE_SIZE, ROUND_ITERATIONS = 128, 64
MAX_DEPTH, EYE, LIGHT = 8, 4, 3     # K, T and S of the thesis

# scene -> (iterations, methods with a picture, seconds of the thesis by its name of the technique)
SCENES = {'thesis-empty': (100, ('path', 'bdpt', 'exact', 'vcm'),
                           {'PT': 55.35, 'BDPT': 103.72, 'VCM': 170.19, 'reuse': 105.57}),
          'thesis-modified': (200, ('path', 'limited', 'exact', 'vcm'),
                              {'PT': 90.22, 'BDPT': 136.00, 'VCM': 234.57, 'reuse': 155.12})}

ALL_CONNECTIONS = ['light_paths=1', 'connections=-1']
LIMITED = [f'max_eye_depth={EYE}', f'max_light_depth={LIGHT}', 'light_paths=1']
# name -> (title, the technique of the thesis, method, parameters). An eye walk that goes on with a
# probability of 1e-60 never does, which leaves BDPT within the limits, with exact weights; and none
# comes to the end of K segments, which leaves the weights that the thesis gives to heads.
METHODS = {
    'path': ('path tracing', 'PT', 'path', []),
    'bdpt': ('BDPT', 'BDPT', 'bdpt', ALL_CONNECTIONS),
    'limited': ('BDPT within T and S', 'BDPT', 'reuse', LIMITED + ['weights=exact', 'continue_probability=1e-60']),
    'stock': ('BDPT within S, stock weights', 'BDPT', 'reuse',
              [f'max_eye_depth={MAX_DEPTH}', f'max_light_depth={LIGHT}', 'light_paths=1', 'weights=thesis']),
    'vcm': ('VCM', 'VCM', 'vcm', ALL_CONNECTIONS),
    'exact': ('reuse, exact weights', 'reuse', 'reuse', LIMITED + ['weights=exact']),
    'thesis-a': ('reuse, thesis’s weights, reading a', 'reuse', 'reuse',
                 LIMITED + ['weights=thesis', 'thesis_reading=a']),
    'thesis-b': ('reuse, thesis’s weights, reading b', 'reuse', 'reuse',
                 LIMITED + ['weights=thesis', 'thesis_reading=b'])}
REASONS = ('contributed', 'failed_specular', 'failed_occluded', 'failed_zero', 'skipped')

PANEL = 192     # pixels of a picture's side
# The part of the modified box that shows caustics in the mirror sphere: left, top and side over the size.
DETAIL_NAME, DETAIL = 'thesis-detail', (0.215, 0.594, 0.28)


def read(path):
    bitmap = mi.Bitmap(str(path)).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False)
    return np.array(bitmap, dtype=np.float64)


def read_reference(scene):
    folder = ROOT / 'reference' / scene
    spp = json.loads((folder / 'provenance.json').read_text())['spp']
    return Reference(read(folder / 'mean.exr'), read(folder / 'variance.exr') / spp)


def render(scene, method, size, iterations, seed, args):
    """What one process took and counted, with its image; from the folder if it is there."""
    stem = args.folder / f'{scene}-{method}-{size}-{iterations}-{seed}'
    image, stats, record = (stem.with_suffix(s) for s in ('.exr', '.stats.json', '.json'))
    if not record.exists():
        _, _, integrator, parameters = METHODS[method]
        command = [args.duet, 'render', str(ROOT / 'scenes' / scene / 'scene.xml'), '-D', f'size={size}',
                   '-i', integrator, '--spp', str(iterations), '--seed', str(seed), '-t', str(args.threads),
                   '-o', str(image), '--stats', str(stats), '-q']
        for p in [f'max_depth={MAX_DEPTH}'] + parameters:
            command += ['-I', p]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        record.write_text(json.dumps({
            'cpu': after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
            'stats': json.loads(stats.read_text())}))
        print(f'{stem.name}: {json.loads(record.read_text())["cpu"]:.1f} CPU s', file=sys.stderr, flush=True)
    return {**json.loads(record.read_text()), 'image': read(image)}


def table(head, rows):
    lines = [head, ['---'] * len(head)] + rows
    return '\n'.join('| ' + ' | '.join(line) + ' |' for line in lines)


def percent(x, digits=1, sign=False):
    text = f'{100 * x:+.{digits}f} %' if sign else f'{100 * x:.{digits}f} %'
    return text.replace('-', '−')


def cpu_ratio(rounds, method):
    return statistics.median(a['cpu'] / b['cpu'] for a, b in zip(rounds[method], rounds['path']))


def time_table(scene, rounds, pictures, size):
    seconds = SCENES[scene][2]
    rows = []
    for m in rounds:
        thesis = seconds[METHODS[m][1]]
        row = [METHODS[m][0], f'{thesis:.2f}', f'{thesis / seconds["PT"]:.2f}', f'{cpu_ratio(rounds, m):.2f}']
        picture = pictures.get(m)
        row += [f'{picture["cpu"]:.0f}', f'{picture["cpu"] / pictures["path"]["cpu"]:.2f}'] if picture else ['', '']
        rows.append(row)
    return table(['', 'thesis: s', 'ratio', 'Duet: ratio', f'at {size}²: CPU s', 'ratio'], rows)


def connection_table(rounds):
    rows = []
    for method, runs in rounds.items():
        if method == 'path':
            continue
        stats = [r['stats'] for r in runs]
        paths = sum(s['paths']['camera'] for s in stats)
        attempted = sum(s['connections']['attempted'] for s in stats)
        rows.append([METHODS[method][0], f'{attempted / paths:.2f}']
                    + [percent(sum(s['connections'][reason] for s in stats) / attempted) for reason in REASONS]
                    + [percent(sum(s[key] for s in stats) / paths)
                       for key in ('eye_subpaths_at_limit', 'reused_subpaths')])
    return table(['', 'per path', 'contributed', 'specular', 'occluded', 'zero', 'roulette', 'paths at the limit',
                  'continued'], rows)


def error_table(rounds, reference):
    relmse = {m: [trimmed_relmse(r['image'], reference) for r in runs] for m, runs in rounds.items()}
    cpu = {m: [r['cpu'] for r in runs] for m, runs in rounds.items()}
    rows = []
    for method, runs in rounds.items():
        j = judge([r['image'] for r in runs], reference)
        efficiency = (statistics.median(cpu['path']) * statistics.mean(relmse['path'])
                      / (statistics.median(cpu[method]) * statistics.mean(relmse[method])))
        span = ('—' if not j['rejected'] else
                f'{percent(j["lowest"], sign=True)} to {percent(j["highest"], sign=True)}')
        rows.append([METHODS[method][0], f'{percent(j["bias"], 2, True)} ± {percent(j["error"], 2)}',
                     f'{j["rejected"]} / {j["tiles"]}', span, f'{j["mean_z2"]:.2f}',
                     f'{statistics.mean(relmse[method]):.2g}', f'{efficiency:.2f}'])
    return table(['', 'mean', 'tiles rejected', 'these differ by', 'mean z²', 'trimmed', 'efficiency'], rows)


def write_png(image, path):
    bitmap = mi.Bitmap(image.astype(np.float32)).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.UInt8, True)
    bitmap.write(str(path), quality=9)


def write_figures(scene, runs):
    for method, run in runs.items():
        image = run['image']
        size = len(image)
        whole = np.array(mi.Bitmap(image.astype(np.float32)).resample((PANEL, PANEL)))
        write_png(whole, IMAGES / f'{scene}-{method}.png')
        if scene == 'thesis-modified':
            left, top, side = (int(x * size) for x in DETAIL)
            write_png(image[top:top + side, left:left + side], IMAGES / f'{DETAIL_NAME}-{method}.png')


def bench(args):
    counts = ' and '.join(str(args.iterations or n) for n, _, _ in SCENES.values())
    tables = {'settings': f'This page: {args.rounds} rounds of {ROUND_ITERATIONS} iterations at {REFERENCE_SIZE}², '
                          f'{args.threads} threads; pictures of {counts} iterations at {args.size}².'}
    for scene, (iterations, pictured, _) in SCENES.items():
        reference = read_reference(scene)
        rounds = {m: [] for m in METHODS}
        for seed in range(1, args.rounds + 1):
            for m in METHODS:
                rounds[m].append(render(scene, m, REFERENCE_SIZE, ROUND_ITERATIONS, seed, args))
        pictures = {} if args.quick else {
            m: render(scene, m, args.size, args.iterations or iterations, 1, args) for m in pictured}
        tables[f'times {scene}'] = time_table(scene, rounds, pictures, args.size)
        tables[f'connections {scene}'] = connection_table(rounds)
        tables[f'errors {scene}'] = error_table(rounds, reference)
        if pictures:
            write_figures(scene, pictures)
    return tables


def place(name):
    return re.compile(f'(<!-- {name} -->\n).*?(<!-- end -->)', re.DOTALL)


def check_places(text):
    names = ['settings'] + [f'{kind} {scene}' for kind in ('times', 'connections', 'errors') for scene in SCENES]
    missing = [name for name in names if len(place(name).findall(text)) != 1]
    if missing:
        sys.exit(f'{PAGE}: needs one place each for {", ".join(missing)}')


def replace_tables(text, tables):
    for name, content in tables.items():
        text = place(name).sub(lambda m: f'{m[1]}\n{content}\n\n{m[2]}', text)
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--iterations', type=int)
    parser.add_argument('--size', type=int, default=512)
    parser.add_argument('--rounds', type=int, default=16)
    parser.add_argument('--threads', type=int, default=2)
    parser.add_argument('--duet', default=str(ROOT / 'build' / 'duet'))
    parser.add_argument('--folder', type=Path)
    parser.add_argument('--quick', action='store_true')
    args = parser.parse_args()
    if args.quick:
        args.rounds = 4
    if args.rounds < 2:
        parser.error('--rounds needs at least 2')
    if not args.quick:
        check_places(PAGE.read_text())
    with tempfile.TemporaryDirectory() as folder:
        args.folder = args.folder or Path(folder)
        args.folder.mkdir(parents=True, exist_ok=True)
        tables = bench(args)
    if args.quick:
        print('\n\n'.join(f'{name}\n\n{content}' for name, content in tables.items()))
    else:
        PAGE.write_text(replace_tables(PAGE.read_text(), tables))


if __name__ == '__main__':
    main()
