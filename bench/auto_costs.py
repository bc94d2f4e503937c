#!/usr/bin/env python3
"""Fits the costs by which `auto` compares methods (src/integrators/method_costs.cpp).

    auto_costs.py [--duet build/duet] [--rounds 3] [--spp 16] [--size 128] [--json FILE] [SCENE...]

Renders each scene with path tracing and with methods that walk from both ends, in turn, as whole processes with one
thread, and counts what they do by --stats. CPU seconds per sample, less those of starting up, are then explained by
the counts with non-negative least squares of relative errors: one set of costs for path, which traces paths in batches, one for
volpath, which takes its place where there are media, and two for the rest: sub-paths one by one, and eye sub-paths in batches. In media there is no ppm. With --json FILE
the counts of a file that is there are fitted, or are written to it.
Prints the lines of the source file and how well they explain what was measured. Needs numpy and scipy.
"""
import argparse
import json
import resource
import statistics
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from scipy.optimize import nnls

ROOT = Path(__file__).resolve().parent.parent
SCENES = ['thesis-empty', 'thesis-modified', 'cornell-box', 'lights-area', 'lights-delta', 'environment-map',
          'mesh-lumpy', 'bsdf-plastics', 'textures', 'instances', 'door-ajar', 'many-lights', 'media-homogeneous',
          'media-heterogeneous', 'media-boundaries']
METHODS = {
    'path': ['path'],
    'half-light': ['bdpt', 'light_paths=0.5', 'connections=0'],
    'light': ['bdpt', 'light_paths=1', 'connections=0'],
    'bdpt': ['bdpt', 'light_paths=1'],
    'bdpt/4': ['bdpt', 'light_paths=0.25'],
    'vcm': ['vcm', 'light_paths=1'],
    'vcm/4': ['vcm', 'light_paths=0.25'],
    'ppm': ['ppm', 'light_paths=1'],
}


def run(duet, scene, method, spp, size, folder):
    name, *parameters = method
    stats = folder / 'stats.json'
    command = [duet, 'render', str(scene), '-q', '-t', '1', '-i', name, '--spp', str(spp), '--size', f'{size}x{size}',
               '-o', str(folder / 'image.exr'), '--stats', str(stats)]
    for p in parameters:
        command += ['-I', p]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, json.loads(stats.read_text())


def work(stats, path, light):
    """The counts of WorkPerSample. What eye walks do by themselves is told by path tracing."""
    samples = stats['paths']['camera']
    walks = stats['paths']['light'] / samples
    c = stats['connections']
    rays = (c['contributed'] + c['failed_occluded']) / samples
    photons = stats['integrator'] == 'ppm'
    per_walk = (light['rays']['closest'] - path['rays']['closest']) / light['paths']['light']
    closest = stats['rays']['closest'] / samples
    shadow = stats['rays']['shadow'] / samples
    light_rays = walks * per_walk
    eye_rays = closest - light_rays if photons else path['rays']['closest'] / samples
    nee = 0 if photons else path['rays']['shadow'] / samples
    stores = stats['merges']['queried'] > 0 or c['attempted'] > 0
    steps = stats['medium_steps'] / samples
    return {'1': 1, 'eye_rays': eye_rays, 'light_samples': nee, 'light_rays': light_rays,
            'camera_rays': max(0, shadow - nee - rays), 'connections': (c['attempted'] - c['failed_specular'] - c['failed_zero']) / samples,
            'zero_connections': c['failed_zero'] / samples, 'connection_rays': rays, 'medium_steps': steps, 'merge_queries': stats['merges']['queried'] / samples,
            'merges': stats['merges']['accepted'] / samples, 'stored_vertices': light_rays if stores else 0}


def fit(rows, names):
    a = np.array([[row[n] / row['microseconds'] for n in names] for row in rows])
    x, _ = nnls(a, np.ones(len(rows)))
    return x, a @ x


def measure(o):
    """A row of counts and microseconds per sample for every scene and method."""
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        for name in o.scenes:
            scene = ROOT / 'scenes' / name / 'scene.xml'
            methods = dict(METHODS)
            if '<medium' in scene.read_text():
                methods['path'] = ['volpath']
                del methods['ppm']
            cpu = {m: [] for m in methods}
            stats, start = {}, []
            for _ in range(o.rounds):
                start.append(run(o.duet, scene, methods['path'], 1, 8, folder)[0])
                for m, method in methods.items():
                    seconds, stats[m] = run(o.duet, scene, method, o.spp, o.size, folder)
                    cpu[m].append(seconds)
            for m in methods:
                row = work(stats[m], stats['path'], stats['light'])
                row['microseconds'] = 1e6 * (min(cpu[m]) - min(start)) / stats[m]['paths']['camera']
                row['scene'], row['method'] = name, methods[m][0] if m == 'path' else m
                row['batches'] = m != 'ppm' and methods['path'] != ['volpath']
                rows.append(row)
            print(name, ' '.join(f'{r["method"]} {r["microseconds"]:.2f}' for r in rows[-len(methods):]), flush=True)
    return rows


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument('scenes', nargs='*', default=SCENES)
    p.add_argument('--duet', default=str(ROOT / 'build/duet'))
    p.add_argument('--rounds', type=int, default=3)
    p.add_argument('--spp', type=int, default=16)
    p.add_argument('--size', type=int, default=128)
    p.add_argument('--json', type=Path)
    o = p.parse_args()
    if o.json and o.json.exists():
        rows = json.loads(o.json.read_text())
    else:
        rows = measure(o)
        if o.json:
            o.json.write_text(json.dumps(rows, indent=1))
    names = ['1', 'eye_rays', 'light_samples', 'medium_steps']
    both = names + ['light_rays', 'camera_rays', 'connections', 'zero_connections', 'connection_rays', 'merge_queries',
                    'merges', 'stored_vertices']
    others = [r for r in rows if r['method'] not in ('path', 'volpath')]
    for title, part, terms in (('path_cost', [r for r in rows if r['method'] == 'path'], names[:3]),
                               ('volpath_cost', [r for r in rows if r['method'] == 'volpath'], names),
                               ('bidirectional_cost', [r for r in others if not r['batches']], both),
                               ('batched_cost', [r for r in others if r['batches']], both)):
        if not part:
            continue
        x, explained = fit(part, terms)
        print(title, ' + '.join(f'{v:.3f} {n}' for v, n in zip(x, terms)))
        spread = np.abs(np.log(np.maximum(explained, 1e-9)))
        print(f'  explained within a factor of {np.exp(np.median(spread)):.2f} (median), {np.exp(spread.max()):.2f} (worst)')
        for r, e in zip(part, explained):
            print(f'  {r["scene"]:18} {r["method"]:10} {r["microseconds"]:7.2f} µs, fitted {e * r["microseconds"]:7.2f}')


if __name__ == '__main__':
    main()
