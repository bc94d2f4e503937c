#!/usr/bin/env python3
"""How honest `--target-error` is: the error it promises against the one that is really made.

    target_error.py [--duet build/duet] [--runs 50] [SCENE:METHOD:TARGET...]

Renders each scene many times with different seeds until the estimated relative error is below the target. The true
error of an image is its distance from the mean of all others, with their share of the noise taken off: no reference
is as good as that. Printed are the share of the runs whose true relative root mean square error is within 20 % of the
estimate (asked for are 90 %), the median and the extremes of true over estimated, samples per pixel, and the mean of
all runs over that of Mitsuba's reference, with its standard error. Needs numpy and mitsuba, which reads the images.
"""
import argparse
import json
import subprocess
import tempfile
from pathlib import Path

import mitsuba as mi
import numpy as np

from auto import ROOT, size_of

mi.set_variant('scalar_rgb')

CASES = ['cornell-box:auto:8%', 'thesis-empty:path:8%', 'thesis-empty:bdpt:8%', 'thesis-modified:auto:8%',
         'lights-area:auto:8%', 'lights-delta:auto:5%', 'environment-map:auto:8%', 'textures:auto:5%',
         'instances:auto:5%', 'depth-of-field:auto:5%']


def read(path):
    colours = mi.Bitmap(str(path)).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32)
    return np.array(colours).astype(float)


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument('cases', nargs='*', default=CASES)
    p.add_argument('--duet', default=str(ROOT / 'build/duet'))
    p.add_argument('--runs', type=int, default=50)
    o = p.parse_args()
    print(f'{"scene":18}{"method":8}{"target":>7}{"within 20 %":>13}{"true / estimated":>22}{"spp":>8}{"mean - 1, %":>20}')
    for case in o.cases:
        name, method, target = case.split(':')
        width, height = size_of(name)
        images, estimates, spp = [], [], []
        with tempfile.TemporaryDirectory() as folder:
            image, stats = Path(folder) / 'image.exr', Path(folder) / 'stats.json'
            for seed in range(1, o.runs + 1):
                subprocess.run([o.duet, str(ROOT / 'scenes' / name / 'scene.xml'), '-q', '-i', method, '--target-error',
                                target, '--seed', str(seed), '--size', f'{width}x{height}', '-o', str(image),
                                '--stats', str(stats)], check=True)
                done = json.loads(stats.read_text())
                estimates.append(done['error']['relative_rmse_estimate'])
                spp.append(done['spp'])
                images.append(read(image))
        images = np.array(images)
        noise = images.var(0, ddof=1).mean() / (o.runs - 1)      # of the mean of the others
        others = (images.sum(0) - images) / (o.runs - 1)
        error = np.sqrt(((images - others) ** 2).mean((1, 2, 3)) - noise) / images.mean()
        ratio = error / estimates
        means = images.mean((1, 2, 3)) / read(ROOT / 'reference' / name / 'mean.exr').mean()
        print(f'{name:18}{method:8}{target:>7}{100 * (abs(ratio - 1) <= 0.2).mean():11.0f} %'
              f'{np.median(ratio):10.2f} ({ratio.min():.2f}-{ratio.max():.2f}){np.median(spp):8.0f}'
              f'{100 * (means.mean() - 1):12.3f} ± {100 * means.std(ddof=1) / o.runs ** 0.5:.3f}', flush=True)


if __name__ == '__main__':
    main()
