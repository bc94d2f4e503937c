#!/usr/bin/env python3
"""What merging gains where light reaches the eye through glass and mirrors: the thesis's modified box.

    caustics.py [--rounds 4] [--iterations 64] [--size 512] [--threads 2] [--duet PATH] [--folder DIR]

Each round renders the box (max_depth 8) with Duet's path, vcm, bpm and ppm and with Mitsuba's llvm_ad_rgb path,
one after the other as whole processes, and takes user + system CPU seconds and the error against a reference:
eight images by vcm, each of --iterations with another seed and a small radius. Their spread says how noisy
their mean is, which is taken off the errors. Printed are medians of the rounds' efficiencies
1 / (trimmed relMSE · CPU s) and their ratios, and the bias of the whole image with its standard error: against
the reference in the repository, which is Mitsuba's, at a size of its own. --folder keeps the reference. Needs
mitsuba and numpy.
"""
import argparse
import math
import statistics
import sys
import tempfile
from pathlib import Path

import numpy as np

from peers import RENDER_WITH_MITSUBA, ROOT, cpu_seconds, read
from thesis import read_reference
from unbiased import Reference, trimmed_relmse

SCENE = ROOT / 'scenes' / 'thesis-modified' / 'scene.xml'
REFERENCE_IMAGES, REFERENCE_RADIUS = 8, 0.003
DUET, MITSUBA = ('path', 'vcm', 'bpm', 'ppm'), 'llvm_ad_rgb'


def duet(args, method, seed, out, *parameters):
    command = [args.duet, 'render', str(SCENE), '-D', f'size={args.size}', '-i', method, '-I', 'max_depth=8',
               '--spp', str(args.iterations), '--seed', str(seed), '-t', str(args.threads), '-q', '-o', str(out)]
    return command + [word for p in parameters for word in ('-I', p)]


def mitsuba(args, seed, out):
    return [sys.executable, RENDER_WITH_MITSUBA, MITSUBA, str(SCENE), str(out), str(args.iterations),
            str(seed), str(args.size), str(args.size), str(args.threads)]


def reference(args):
    images = []
    for i in range(REFERENCE_IMAGES):
        out = args.folder / f'reference-{args.size}-{args.iterations}-{i}.exr'
        if not out.exists():
            cpu_seconds(duet(args, 'vcm', 1000 + i, out, f'radius={REFERENCE_RADIUS}'))
        images.append(read(out))
    return Reference(np.mean(images, axis=0), np.var(images, axis=0, ddof=1) / len(images))


def mitsubas_mean():
    """The mean of the repository's reference and its standard error."""
    mitsubas = read_reference('thesis-modified')
    variance = mitsubas.grey_variance
    return mitsubas.mean.mean(), math.sqrt(variance.sum()) / variance.size


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--rounds', type=int, default=4)
    parser.add_argument('--iterations', type=int, default=64)
    parser.add_argument('--size', type=int, default=512)
    parser.add_argument('--threads', type=int, default=2)
    parser.add_argument('--duet', default=str(ROOT / 'build' / 'duet'))
    parser.add_argument('--folder', type=Path, default=Path(tempfile.gettempdir()) / 'duet-references')
    args = parser.parse_args()
    args.folder.mkdir(parents=True, exist_ok=True)
    truth = reference(args)
    runs = {label: [] for label in DUET + (MITSUBA,)}
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / 'image.exr'
        for seed in range(1, args.rounds + 1):
            for label in runs:
                seconds = cpu_seconds(mitsuba(args, seed, out) if label == MITSUBA else
                                      duet(args, label, seed, out))
                image = read(out)
                runs[label].append((seconds, trimmed_relmse(image, truth), image.mean()))
    expected, doubt = mitsubas_mean()
    print(f'{args.size}², {args.iterations} samples, {args.rounds} rounds; mean of the reference '
          f'{truth.mean.mean() / expected - 1:+.2%} from Mitsuba\'s ± {doubt / expected:.2%}\n')
    print('| | CPU s | trimmed | efficiency / Duet\'s path | / llvm_ad_rgb path | bias |\n|---|---|---|---|---|---|')
    for label, values in runs.items():
        gain = [statistics.median(o[0] * o[1] / (v[0] * v[1]) for v, o in zip(values, runs[other]))
                for other in ('path', MITSUBA)]
        means = [v[2] for v in values]
        error = math.hypot(doubt, statistics.stdev(means) / math.sqrt(len(means)) if len(means) > 1 else 0)
        print(f'| {label} | {statistics.median(v[0] for v in values):.1f} '
              f'| {statistics.median(v[1] for v in values):.5f} | {gain[0]:.1f} | {gain[1]:.1f} '
              f'| {statistics.mean(means) / expected - 1:+.2%} ± {error / expected:.2%} |')


if __name__ == '__main__':
    main()
