#!/usr/bin/env python3
"""What choosing lights by a tree gains where there are many, and what it costs where there are few.

    many_lights.py --duet build/duet [--bulbs 10000] [--size 96] [--spp 16] [--repeats 4] [--scene FILE...]

Without --scene: a street between two rows of houses under chains of bulbs, made from a seed (--write FILE keeps it), with
path and bdpt. With --scene: those scenes. Each is rendered with light_selection=bvh (auto for --scene) and =power in
turns. Efficiency is 1 / (trimmed relmse · CPU seconds), where the seconds are user and system time of the process less
those of one with one sample. The error is against an image of the other method with 64 times as many samples.
"""
import argparse
import json
import random
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

REFERENCE_FACTOR = 64


def house(r, side, y):
    width, height = r.uniform(6, 9), r.uniform(5, 12)
    grey = r.uniform(0.3, 0.7)
    return (f'<shape type="cube"><transform name="to_world"><scale x="3" y="{width / 2:.2f}" z="{height / 2:.2f}"/>'
            f'<translate x="{side * 8}" y="{y:.2f}" z="{height / 2:.2f}"/></transform><bsdf type="diffuse">'
            f'<rgb name="reflectance" value="{grey:.2f}, {grey * 0.9:.2f}, {grey * 0.8:.2f}"/></bsdf></shape>')


def street(bulbs, seed=1):
    """Chains of bulbs across a street of 200 units, the bulbs of every fifth chain 16 times as bright."""
    r = random.Random(seed)
    parts = ['<scene version="3.0.0"><integrator type="path"><integer name="max_depth" value="5"/>'
             '<boolean name="hide_emitters" value="true"/></integrator>'
             '<sensor type="perspective"><float name="fov" value="60"/><transform name="to_world">'
             '<lookat origin="0.5, -4, 1.7" target="0, 40, 3" up="0, 0, 1"/></transform><film type="hdrfilm">'
             '<integer name="width" value="96"/><integer name="height" value="72"/><rfilter type="box"/></film></sensor>'
             '<shape type="rectangle"><transform name="to_world"><scale x="60" y="140"/><translate y="90"/></transform>'
             '<bsdf type="diffuse"><rgb name="reflectance" value="0.3"/></bsdf></shape>']
    for side in (-1, 1):
        parts += [house(r, side, y) for y in range(-10, 200, 8)]
    per_chain = 50
    for i in range(bulbs):
        chain, k = divmod(i, per_chain)
        x = -4.8 + 9.6 * (k + 0.5) / per_chain
        y = 200 * (chain + 0.5) / max(bulbs / per_chain, 1)
        z = 4 + 0.06 * x * x + r.uniform(-0.05, 0.05)
        radiance = 16 * r.uniform(0.5, 2) * (16 if chain % 5 == 0 else 1)
        parts.append(f'<shape type="sphere"><point name="center" x="{x:.3f}" y="{y:.3f}" z="{z:.3f}"/><float name="radius" '
                     f'value="0.03"/><emitter type="area"><rgb name="radiance" value="{radiance:.2f}, {radiance * 0.8:.2f}, '
                     f'{radiance * 0.5:.2f}"/></emitter></shape>')
    return '\n'.join(parts + ['</scene>'])


def render(duet, scene, image, method, selection, spp, seed, size):
    """CPU seconds of the process."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = [duet, 'render', str(scene), '-q', '-t', '1', '--spp', str(spp), '--seed', str(seed), '-o', str(image)]
    if method:
        command += ['-i', method]
    if selection:
        command += ['--light-selection', selection]
    if size:
        command += ['--size', size]
    subprocess.run(command, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def error(duet, image, reference):
    found = subprocess.run([duet, 'compare', str(image), str(reference), '--json'], stdout=subprocess.PIPE, text=True)
    return json.loads(found.stdout)


def figures(o, scene, method, other, selections, folder):
    """By selection, CPU seconds, trimmed relmse and efficiency: medians over the repeats."""
    reference = folder / f'{scene.stem}-{method}-reference.exr'
    render(o.duet, scene, reference, other, selections[0], o.spp * REFERENCE_FACTOR, 99, o.size)
    rows = {s: [] for s in selections}
    for i in range(o.repeats):
        for s in selections:
            image = folder / 'image.exr'
            start = render(o.duet, scene, image, method, s, 1, i, o.size)
            seconds = render(o.duet, scene, image, method, s, o.spp, i, o.size) - start
            rows[s].append((seconds, error(o.duet, image, reference)['trimmed']))
    return {s: (statistics.median(t for t, _ in r), statistics.mean(e for _, e in r)) for s, r in rows.items()}


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument('--duet', required=True)
    p.add_argument('--bulbs', type=int, default=10000)
    p.add_argument('--size', default='')
    p.add_argument('--spp', type=int, default=16)
    p.add_argument('--repeats', type=int, default=4)
    p.add_argument('--methods', default='path,bdpt')
    p.add_argument('--scene', nargs='*', default=[], type=Path)
    p.add_argument('--write', type=Path, help='only write the street to this file')
    o = p.parse_args()
    if o.write:
        o.write.write_text(street(o.bulbs))
        return
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        made = folder / 'street.xml'
        made.write_text(street(o.bulbs))
        methods = o.methods.split(',')
        print('| scene | method | selection | CPU s | trimmed relmse | efficiency over power |\n|---|---|---|---|---|---|')
        for scene in o.scene or [made]:
            selections = ['auto' if o.scene else 'bvh', 'power']
            for method in methods:
                other = 'bdpt' if method == 'path' else 'path'
                found = figures(o, scene, method, other, selections, folder)
                base = found['power'][0] * found['power'][1]
                for s, (seconds, relmse) in found.items():
                    print(f'| {scene.stem} | {method} | {s} | {seconds:.2f} | {relmse:.3g} | '
                          f'{base / (seconds * relmse):.3g} |')
                    sys.stdout.flush()


if __name__ == '__main__':
    main()
