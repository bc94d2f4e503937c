#!/usr/bin/env python3
"""How well `auto` chooses: its efficiency against every fixed method's, and what it has chosen.

    auto.py [--duet build/duet] [--rounds 5] [--spp 64] [--references DIR] [--json FILE] [SCENE...]

Each round renders every scene at the size of its reference with auto and with path, bdpt, vcm and ppm as they
come, one after the other, as whole processes with two threads, each round with a seed of its own. Efficiency is
1 / (trimmed relMSE · CPU s), with relMSE = mean of (a − b)² / (b² + 0.01) without the worst 0.1 % of the pixels
and user + system seconds of the process, the pilot included.

References are those of reference/ where Mitsuba has made one, and else are made with many samples of bdpt, or of vcm
where only merging finds all light, and kept in --references. Printed are for each scene the medians over the rounds of the
efficiencies relative to path in the same round, and what auto reaches of the best fixed method's. A method whose mean over
the rounds is more than 0.2 %, and than three standard errors, below the reference's loses light: it is marked with a
star and not the best.
"""
import argparse
import json
import math
import resource
import statistics
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SCENES = ['thesis-empty', 'thesis-modified', 'box-point', 'box-spheres', 'door-ajar', 'sun-glass', 'many-lights',
          'environment-map', 'lamp-in-glass', 'glossy-kitchen', 'textures', 'instances', 'lights-area', 'cornell-box']
FIXED = ['path', 'bdpt', 'vcm', 'ppm']
REFERENCE_SPP = 1024
NEGLIGIBLE_LOSS = 2e-3
BDPT_SUFFICES = {'door-ajar', 'many-lights', 'glossy-kitchen'}


def run(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def error(duet, image, reference):
    result = subprocess.run([duet, 'compare', str(image), str(reference), '--json'], check=True, capture_output=True)
    return json.loads(result.stdout)


def size_of(name):
    provenance = ROOT / 'reference' / name / 'provenance.json'
    return json.loads(provenance.read_text())['size'] if provenance.exists() else [128, 128]


def reference(duet, name, scene, size, folder):
    made = ROOT / 'reference' / name / 'mean.exr'
    if made.exists():
        return made
    cached = folder / f'{name}-{size[0]}x{size[1]}.exr'
    if not cached.exists():
        folder.mkdir(parents=True, exist_ok=True)
        run([duet, 'render', str(scene), '-q', '-i', 'bdpt' if name in BDPT_SUFFICES else 'vcm',
             '--spp', str(REFERENCE_SPP), '--seed', '999', '--size', f'{size[0]}x{size[1]}', '-o', str(cached)])
    return cached


def loses_light(means):
    error = statistics.stdev(means) / math.sqrt(len(means)) if len(means) > 1 else 0
    return 1 - statistics.mean(means) > max(NEGLIGIBLE_LOSS, 3 * error)


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument('scenes', nargs='*', default=SCENES)
    p.add_argument('--duet', default=str(ROOT / 'build/duet'))
    p.add_argument('--rounds', type=int, default=5)
    p.add_argument('--spp', type=int, default=64)
    p.add_argument('--threads', type=int, default=2)
    p.add_argument('--references', type=Path, default=Path.home() / '.cache/duet/auto')
    p.add_argument('--json', type=Path)
    o = p.parse_args()
    table = {}
    print(f'{"scene":18}' + ''.join(f'{m:>8}' for m in FIXED + ['auto']) + '  of best  auto chose')
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        for name in o.scenes:
            scene, size = ROOT / 'scenes' / name / 'scene.xml', size_of(name)
            truth = reference(o.duet, name, scene, size, o.references)
            efficiency = {m: [] for m in FIXED + ['auto']}
            means = {m: [] for m in efficiency}
            chosen = ''
            for r in range(o.rounds):
                for m in efficiency:
                    image, stats = folder / 'image.exr', folder / 'stats.json'
                    cpu = run([o.duet, 'render', str(scene), '-q', '-i', m, '--spp', str(o.spp), '--seed', str(r + 1),
                               '-t', str(o.threads), '--size', f'{size[0]}x{size[1]}', '-o', str(image),
                               '--stats', str(stats)])
                    if m == 'auto':
                        chosen = json.loads(stats.read_text())['chosen']['reason'].split(':')[0]
                    figures = error(o.duet, image, truth)
                    efficiency[m].append(1 / (figures['trimmed'] * cpu))
                    means[m].append(statistics.mean(figures['mean_ratio']))
            relative = {m: statistics.median(e / p for e, p in zip(efficiency[m], efficiency['path']))
                        for m in efficiency}
            lossy = [m for m in efficiency if loses_light(means[m])]
            best = relative['auto'] / max(relative[m] for m in FIXED if m not in lossy)
            table[name] = {**relative, 'of_best': best, 'chosen': chosen, 'means': means}
            print(f'{name:18}' + ''.join(f'{relative[m]:7.2f}' + ' *'[m in lossy] for m in efficiency)
                  + f'{best:9.2f}  {chosen}', flush=True)
    mean = math.exp(statistics.mean(math.log(t['auto']) for t in table.values()))
    print(f'geometric mean against path: {mean:.2f}; least share of the best: {min(t["of_best"] for t in table.values()):.2f}')
    if o.json:
        o.json.write_text(json.dumps(table, indent=1) + '\n')


if __name__ == '__main__':
    main()
