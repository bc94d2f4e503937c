#!/usr/bin/env python3
"""How honest `--target-error` is: the error it promises against the one that is really made.

    target_error.py [--duet build/duet] [--runs 50] [--references DIR] [SCENE:METHOD:TARGET...]

Renders each scene many times with different seeds until the estimated relative error is below the target, and
compares each image with the converged reference that bench/auto.py uses, too. Printed are the share of the runs whose true relative root mean square error is within
20 % of the estimate (asked for are 90 %), the median and the extremes of true over estimated, the mean of all runs
over the reference's with its standard error, and samples per pixel.
"""
import argparse
import json
import statistics
import subprocess
import tempfile
from pathlib import Path

from auto import ROOT, reference, size_of

CASES = ['cornell-box:auto:10%', 'thesis-empty:auto:8%', 'thesis-empty:bdpt:8%', 'lights-area:auto:8%',
         'environment-map:auto:8%', 'many-lights:auto:10%', 'textures:auto:8%', 'instances:auto:8%']


def json_of(command):
    return json.loads(subprocess.run(command, check=True, capture_output=True).stdout)


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument('cases', nargs='*', default=CASES)
    p.add_argument('--duet', default=str(ROOT / 'build/duet'))
    p.add_argument('--runs', type=int, default=50)
    p.add_argument('--references', type=Path, default=Path.home() / '.cache/duet/auto')
    o = p.parse_args()
    print(f'{"scene":18}{"method":8}{"target":>7}{"within 20 %":>13}{"true / estimated":>22}'
          f'{"mean - 1, %":>20}{"spp":>8}')
    for case in o.cases:
        name, method, target = case.split(':')
        scene = ROOT / 'scenes' / name / 'scene.xml'
        size = size_of(name)
        truth = reference(o.duet, name, scene, size, o.references)
        size = f'{size[0]}x{size[1]}'
        ratios, means, spp = [], [], []
        with tempfile.TemporaryDirectory() as folder:
            image, stats = Path(folder) / 'image.exr', Path(folder) / 'stats.json'
            for seed in range(1, o.runs + 1):
                subprocess.run([o.duet, str(scene), '-q', '-i', method, '--target-error', target, '--seed', str(seed),
                                '--size', size, '-o', str(image), '--stats', str(stats)], check=True)
                done = json.loads(stats.read_text())
                figures = json_of([o.duet, 'compare', str(image), str(truth), '--json'])
                ratios.append(figures['relrmse'] / done['error']['relative_rmse_estimate'])
                means.append(statistics.mean(figures['mean_ratio']))
                spp.append(done['spp'])
        within = sum(abs(r - 1) <= 0.2 for r in ratios) / len(ratios)
        error = statistics.stdev(means) / len(means) ** 0.5
        print(f'{name:18}{method:8}{target:>7}{100 * within:11.0f} %'
              f'{statistics.median(ratios):10.2f} ({min(ratios):.2f}-{max(ratios):.2f})'
              f'{100 * (statistics.mean(means) - 1):12.3f} ± {100 * error:.3f}{statistics.median(spp):8.0f}', flush=True)


if __name__ == '__main__':
    main()
