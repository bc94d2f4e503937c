#!/usr/bin/env python3
"""Measures the test for bias of `duet compare` on unbiased images and on planted defects (docs/compare.md).

    calibrate_compare.py PROGRAM RESULTS.csv [--jobs 2] [--only NAME...]    renders and tests what is missing
    calibrate_compare.py --table RESULTS.csv                               prints the tables as Markdown

PROGRAM is `calibrate_compare`, built with -DDUET_BUILD_BENCH=ON. Every reference of reference/ is used; the
images are windows in its middle where that saves time. All seeds are other ones than those with which the
test was designed. Needs nothing but Python.
"""
import argparse
import json
import math
import subprocess
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Lock

ROOT = Path(__file__).resolve().parent.parent
FIRST_SEED = 301
BLOCK = 4               # seeds of one run
BLOCKS = 2              # of each sequence: 2 · 4 seeds of Sobol' points and as many of independent ones
# Samples per pixel and the window in which they are rendered.
SIZES = ('16:64x48', '64:48x32', '256:32x24', '1024:24x16')
SMALL = ('camera', 'hide-behind', 'batch')      # too small for windows
BIDIRECTIONAL = ('bsdf-conductors', 'bsdf-dielectrics', 'cornell-box', 'environment-map', 'filters-gaussian', 'instances',
                 'lights-area', 'lights-placed', 'shapes', 'textures', 'thesis-empty', 'thesis-modified')
CAUSTICS = ('bsdf-conductors', 'bsdf-dielectrics', 'thesis-modified')
SIGNIFICANCE = 0.01
COLUMNS = ('kind', 'reference', 'method', 'sequence', 'spp', 'seed', 'width', 'height', 'p', 'dark_p', 'lit', 'noticed',
           'clamped_p', 'clamped', 'clamped_tile')


def references():
    for file in sorted(ROOT.glob('reference/*/provenance.json')):
        yield file.parent.name, json.loads(file.read_text())


def tasks(only):
    """(kind, reference, provenance, method, sequence, first seed, seeds, sizes); the most telling ones first."""
    known = [(n, p) for n, p in references() if not only or n in only]
    def sizes(name, chosen):
        return [s.split(':')[0] if name in SMALL else s for s in chosen]
    for block in range(BLOCKS):
        for sequence in ('independent', 'sobol'):
            for name, p in known:
                yield 'alarms', name, p, 'scene', sequence, FIRST_SEED + block * BLOCK, BLOCK, sizes(name, SIZES)
        if block == 0:
            for name, p in known:
                yield 'power', name, p, 'scene', 'independent', FIRST_SEED + 50, 1, ['256']
        for name, p in known:
            if name in BIDIRECTIONAL:
                yield ('alarms', name, p, 'bdpt', 'sobol', FIRST_SEED + block * BLOCK, BLOCK,
                       sizes(name, SIZES[:3]))
    # Without windows, where tiles have more pixels.
    for size, seeds in (('256', 2), ('1024', 1)):
        for sequence in ('independent', 'sobol'):
            for name, p in known:
                yield 'full', name, p, 'scene', sequence, FIRST_SEED + 100, seeds, [size]


def run(program, results, jobs, only):
    done = set()
    if results.exists():
        done = {tuple(row[c] for c in ('kind', 'reference', 'method', 'sequence', 'spp', 'seed'))
                for row in read(results)}
    else:
        results.write_text(','.join(COLUMNS) + '\n')
    lock = Lock()

    def work(task):
        kind, name, p, method, sequence, first, seeds, sizes = task
        sizes = [s for s in sizes if any((kind, name, method, sequence, s.split(':')[0], str(first + k)) not in done
                                         for k in range(seeds))]
        if not sizes:
            return
        command = [program, ROOT / p['scene'], ROOT / 'reference' / name, method, sequence, first, seeds, *sizes]
        command += [f'{k}={v}' for k, v in p['definitions'].items()]
        if kind == 'power':
            command.append('--defects')
        if kind == 'power' and name in CAUSTICS:
            command.append('--clamp')
        answer = subprocess.run([str(c) for c in command], capture_output=True, text=True)
        with lock, results.open('a') as file:
            for line in answer.stdout.splitlines():
                file.write(f'{kind},{name},{method},{sequence},{line}\n')
        if answer.returncode:
            print(name, method, sequence, answer.stderr, flush=True)

    with ThreadPoolExecutor(jobs) as pool:
        for _ in pool.map(work, tasks(only)):
            pass


def read(results):
    lines = results.read_text().splitlines()
    rows = {}
    for line in lines[1:]:
        row = dict(zip(COLUMNS, line.split(',')))
        rows[tuple(row[c] for c in COLUMNS[:6])] = row
    return list(rows.values())


def binomial_tail(k, n, p):
    """P(X >= k) of n trials."""
    if k <= 0:
        return 1.0
    log = lambda i: (math.lgamma(n + 1) - math.lgamma(i + 1) - math.lgamma(n - i + 1)
                     + i * math.log(p) + (n - i) * math.log1p(-p))
    return min(1.0, sum(math.exp(log(i)) for i in range(k, n + 1)))


def clopper_pearson(k, n, level=0.95):
    """Interval of a share, from k of n. Source: Clopper & Pearson, Biometrika 26, 1934."""
    def solve(f):
        low, high = 1e-12, 1 - 1e-12
        for _ in range(80):
            middle = (low + high) / 2
            low, high = (middle, high) if f(middle) else (low, middle)
        return (low + high) / 2
    alpha = (1 - level) / 2
    return (0.0 if k == 0 else solve(lambda p: binomial_tail(k, n, p) < alpha),
            1.0 if k == n else solve(lambda p: binomial_tail(k + 1, n, p) < 1 - alpha))


def share(hits, of):
    low, high = clopper_pearson(hits, of)
    return f'{hits} of {of}: {100 * hits / of:.2f} % ({100 * low:.2f} to {100 * high:.2f})'


def alarm_tables(rows):
    full = [r for r in rows if r['kind'] == 'full']
    rows = [r for r in rows if r['kind'] == 'alarms']
    alarm = lambda r: float(r['p']) < SIGNIFICANCE
    of = lambda some, method, sequence: [r for r in some if (r['method'], r['sequence']) == (method, sequence)]
    groups = [('the scene\'s method, independent points', of(rows, 'scene', 'independent')),
              ('the scene\'s method, Sobol\' points', of(rows, 'scene', 'sobol')),
              ('`bdpt`, Sobol\' points', of(rows, 'bdpt', 'sobol')),
              ('the scene\'s method, independent, whole images', of(full, 'scene', 'independent')),
              ('the scene\'s method, Sobol\', whole images', of(full, 'scene', 'sobol')),
              ('all', rows + full)]
    counts = sorted({int(r['spp']) for r in rows + full})
    print('| images | scenes | ' + ' | '.join(f'{n:,} spp' for n in counts) + ' | all |')
    print('|---|--:|' + '--:|' * (len(counts) + 1))
    for title, mine in groups:
        if not mine:
            continue
        cells = []
        for n in counts:
            some = [r for r in mine if int(r['spp']) == n]
            cells.append(f'{sum(map(alarm, some))} of {len(some)}' if some else '–')
        scenes = len({r['reference'] for r in mine})
        print(f'| {title} | {scenes} | ' + ' | '.join(cells) + f' | {share(sum(map(alarm, mine)), len(mine))} |')
    print()
    print('| scene | ' + ' | '.join(f'{n:,} spp' for n in counts) + ' | least p |')
    print('|---|' + '--:|' * (len(counts) + 1))
    for name in sorted({r['reference'] for r in rows}):
        mine = [r for r in rows + full if r['reference'] == name]
        cells = []
        for n in counts:
            some = [r for r in mine if int(r['spp']) == n]
            cells.append(f'{sum(map(alarm, some))} / {len(some)}' if some else '–')
        print(f'| `{name}` | ' + ' | '.join(cells) + f' | {min(float(r["p"]) for r in mine):.2g} |')


def power_tables(rows):
    rows = [r for r in rows if r['kind'] == 'power']
    total = defaultdict(lambda: [0, 0])
    print('\n| scene | size | 1 % too dark | a tile 5 % too dark | clamped |\n|---|--:|--:|--:|--:|')
    for name in sorted({r['reference'] for r in rows}):
        mine = [r for r in rows if r['reference'] == name]
        dark = [sum(float(r['dark_p']) < SIGNIFICANCE for r in mine), len(mine)]
        tile = [sum(int(r['noticed']) for r in mine), sum(int(r['lit']) for r in mine)]
        clamped = [r for r in mine if float(r['clamped_p']) >= 0]
        caustic = [sum(float(r['clamped_p']) < SIGNIFICANCE for r in clamped), len(clamped)]
        for key, (hits, of) in (('dark', dark), ('tile', tile), ('clamped', caustic)):
            total[key][0] += hits
            total[key][1] += of
        lost = (f'{caustic[0]} / {caustic[1]}, {100 * float(clamped[0]["clamped"]):.1f} % of the light, '
                f'{100 * float(clamped[0]["clamped_tile"]):.0f} % of a tile' if clamped else '–')
        print(f'| `{name}` | {mine[0]["width"]} × {mine[0]["height"]} | {dark[0]} / {dark[1]} | '
              f'{tile[0]} / {tile[1]} | {lost} |')
    print('\n| defect at 256 spp | noticed |\n|---|--:|')
    for key, title in (('dark', 'the image 1 % too dark'), ('tile', 'a lit tile 5 % too dark'),
                       ('clamped', 'caustics clamped')):
        if total[key][1]:
            print(f'| {title} | {share(*total[key])} |')


def main():
    parser = argparse.ArgumentParser(description='Measure false alarms and power of the test for bias.')
    parser.add_argument('program', nargs='?')
    parser.add_argument('results', type=Path)
    parser.add_argument('--table', action='store_true', help='print the tables')
    parser.add_argument('--jobs', type=int, default=2)
    parser.add_argument('--only', nargs='*', help='names of references')
    args = parser.parse_args()
    if args.table:
        rows = read(args.results)
        alarm_tables(rows)
        power_tables(rows)
    elif args.program:
        run(args.program, args.results, args.jobs, args.only)
    else:
        parser.error('PROGRAM is missing')


if __name__ == '__main__':
    main()
