#!/usr/bin/env python3
"""How honest `--target-error` is: the error it promises against the one that is really made.

    target_error.py [--duet build/duet] [--runs 50] [--size 64] [--references DIR] [SCENE:METHOD:TARGET...]

Renders each scene many times with different seeds until the estimated relative error is below the target, and
compares each image with a converged reference, which is made once by the first unbiased method that suits the scene
and kept in --references. Printed are the share of the runs whose true relative root mean square error is within
20 % of the estimate (asked for are 90 %), the median and the extremes of true over estimated, the mean of all runs
over the reference's with its standard error, and samples per pixel.
"""
import argparse
import json
import statistics
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CASES = ['cornell-box:path:5%', 'thesis-empty:bdpt:3%', 'thesis-modified:bdpt:5%', 'lights-area:auto:3%',
         'environment-map:auto:3%', 'many-lights:auto:4%', 'textures:auto:3%', 'instances:auto:3%']
REFERENCE_SPP = 16384


def json_of(command):
    return json.loads(subprocess.run(command, check=True, capture_output=True).stdout)


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument('cases', nargs='*', default=CASES)
    p.add_argument('--duet', default=str(ROOT / 'build/duet'))
    p.add_argument('--runs', type=int, default=50)
    p.add_argument('--size', type=int, default=64)
    p.add_argument('--references', type=Path, default=Path.home() / '.cache/duet/target-error')
    o = p.parse_args()
    o.references.mkdir(parents=True, exist_ok=True)
    print(f'{"scene":18}{"method":8}{"target":>7}{"within 20 %":>13}{"true / estimated":>22}'
          f'{"mean - 1, %":>20}{"spp":>8}')
    for case in o.cases:
        name, method, target = case.split(':')
        scene = ROOT / 'scenes' / name / 'scene.xml'
        size = f'{o.size}x{o.size}'
        truth = o.references / f'{name}-{size}.exr'
        if not truth.exists():
            unbiased = 'bdpt' if name.startswith('thesis') else 'path'
            subprocess.run([o.duet, str(scene), '-q', '-i', unbiased, '--spp', str(REFERENCE_SPP), '--seed', '999',
                            '--size', size, '-o', str(truth)], check=True)
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
