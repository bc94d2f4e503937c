#!/usr/bin/env python3
"""Renders the pictures that README.md begins with, and says what they took.

    gallery.py render [--duet build/duet] [--error 1%] [--work DIR] [SCENE...]   images and figures, into DIR
    gallery.py publish [--work DIR]     copies them to docs/images and docs/gallery.json
    gallery.py table                    prints the table of docs/gallery.json for README.md

Each scene of scenes/gallery-* is rendered by `auto` on one thread until its relative standard error (docs/figures.md) is
that of --error, and by path tracing (`volpath` in fog) in the same CPU time, user + system seconds of the process. The
samples of the second come from the time that one more sample takes, by two short renders. Where `auto` chose path
tracing itself there is no second image. The error of the second image is its difference from the first, noise of both
and what its method never finds included (`relrmse`). Scenes whose figures are in DIR are not rendered again; those that
have none there stay as they were published.
"""
import argparse
import json
import resource
import shutil
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SCENES = {'gallery-room': 'path', 'gallery-water': 'path', 'gallery-fog': 'volpath', 'gallery-materials': 'path'}
FIGURES = ROOT / 'docs/gallery.json'


def run(*command):
    """Runs a command; returns its CPU seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([str(c) for c in command], check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def render(o, name, image, *options):
    """Renders a scene to DIR/image.exr and .png; returns its statistics, with CPU seconds."""
    path = o.work / image
    cpu = run(o.duet, 'render', ROOT / 'scenes' / name / 'scene.xml', '-q', '-t', 1, '-o', f'{path}.exr', '-o',
              f'{path}.png', '--stats', f'{path}.json', *options)
    return json.loads(Path(f'{path}.json').read_text()) | {'cpu': cpu}


def samples_for(o, name, method, cpu):
    """Samples per pixel that path tracing takes in so many CPU seconds."""
    few, many = 8, 40
    times = [render(o, name, 'trial', '-i', method, '--spp', spp)['cpu'] for spp in (few, many)]
    per_sample = (times[1] - times[0]) / (many - few)
    return max(1, round((cpu - times[0]) / per_sample) + few)


def scene(o, name, method):
    """The figures of a scene."""
    best = render(o, name, name, '--target-error', o.error, '--require-target')
    figures = {'method': best['chosen']['reason'], 'cpu': best['cpu'], 'spp': best['spp'],
               'error': best['error']['relative_standard_error']}
    if best['chosen']['integrator'] == method:
        return figures
    spp = samples_for(o, name, method, best['cpu'])
    path = render(o, name, f'{name}-{method}', '-i', method, '--spp', spp)
    difference = subprocess.run([str(o.duet), 'compare', '--json', str(o.work / f'{name}-{method}.exr'),
                                 str(o.work / f'{name}.exr')], capture_output=True, text=True)
    return figures | {'path': {'method': method, 'cpu': path['cpu'], 'spp': path['spp'],
                               'error': json.loads(difference.stdout)['relrmse']}}


def render_all(o):
    for name in o.scenes or SCENES:
        done = o.work / f'{name}.figures.json'
        if not done.exists():
            done.write_text(json.dumps(scene(o, name, SCENES[name]), indent=2))
            print(name, done.read_text(), flush=True)


def publish(o):
    published = json.loads(FIGURES.read_text()) if FIGURES.exists() else {}
    figures = {}
    for name, method in SCENES.items():
        if not (o.work / f'{name}.figures.json').exists():
            if name in published:
                figures[name] = published[name]
            continue
        figures[name] = json.loads((o.work / f'{name}.figures.json').read_text())
        images = [name] + ([f'{name}-{method}'] if 'path' in figures[name] else [])
        for image in images:
            shutil.copy(o.work / f'{image}.png', ROOT / 'docs/images')
    FIGURES.write_text(json.dumps(figures, indent=2) + '\n')


def table(_):
    print('| `auto`, to an error of 1 % | path tracing for the same time |\n|---|---|')
    for name, f in json.loads(FIGURES.read_text()).items():
        method, path = f['method'].split(':')[0], f.get('path')
        print(f'| ![{name}](docs/images/{name}.png) | '
              + (f'![{name}](docs/images/{name}-{path["method"]}.png)' if path else '') + ' |')
        print(f'| `scenes/{name}`: {method}, {f["spp"]:,} samples per pixel, {f["cpu"]:,.0f} s, {100 * f["error"]:.1f} % | '
              + (f'`{path["method"]}`: {path["spp"]:,} samples per pixel, {path["cpu"]:,.0f} s, {100 * path["error"]:.1f} % from it'
                 if path else '`auto` chose path tracing') + ' |')


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument('task', choices=['render', 'publish', 'table'])
    p.add_argument('scenes', nargs='*', help=', '.join(SCENES))
    p.add_argument('--duet', type=Path, default=ROOT / 'build/duet')
    p.add_argument('--error', default='1%')
    p.add_argument('--work', type=Path, default=ROOT / 'build/gallery')
    o = p.parse_intermixed_args()
    o.work.mkdir(parents=True, exist_ok=True)
    {'render': render_all, 'publish': publish, 'table': table}[o.task](o)


if __name__ == '__main__':
    main()
