#!/usr/bin/env python3
"""How well `auto` chooses: its efficiency against every fixed method's, and what it has chosen.

    auto.py [--set fitted|holdout] [--mitsuba] [--duet build/duet] [--rounds 3] [--spp 64] [--references DIR] [--json FILE]
            [SCENE...]

The fitted set are scenes of scenes/ that have been looked at when the rules and constants of `auto` were found; the hold-out
set is made by bench/holdout_scenes.py, and nothing is fitted on it. Each round renders every scene with auto and with
path, path in groups of 16 pixels, bdpt, vcm and ppm (volpath, bdpt and vcm where there is a medium), one after the
other, as whole processes, each round with a seed of its own. Efficiency is 1 / (error · CPU s), with user + system
seconds of the process, the pilot included, and error the mean over the pixels of ((a − b)² − v) / (b² + 0.01) without
the worst 0.1 % of them: a image, b reference, v the variance of the reference. Figures are medians over the rounds.

References are Mitsuba's of reference/ where there are any, or else the mean of two images of --reference-spp samples
with seeds of their own by a method that is not judged: bdpt with a light walk for every pixel, which is unbiased, or
where only merging finds all light (SDS below) vcm whose radius shrinks nearly to nothing (alpha = 0.1).
`confirmed by` are the fixed methods whose images agree with the reference by the rule that follows.

One rule for all, auto included: an image does not count if its mean is off by more than 0.5 %, or any of 8 × 8 tiles by
more than 2 %, beyond four standard errors, too bright or too dark. Tiles darker than a twentieth of the image are
measured by that. Standard errors come from the rounds and the reference. A fixed method that does not count is marked
with a star and not the best; an auto that does not count reaches 0 of the best. Pixels that share paths (photons, groups)
err alike, which three rounds may take for bias: repeat with more.

--mitsuba renders with the llvm_ad_rgb variant of Mitsuba 3 in each round, too, by the scene's own integrator (path, volpath)
as far as Mitsuba can read it. Its seconds are those of one more image, without start-up (mitsuba_render.py); those of Duet
are of the whole process.
"""
import argparse
import json
import math
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import mitsuba as mi
import numpy as np

import holdout_scenes

mi.set_variant('scalar_rgb')

ROOT = Path(__file__).resolve().parent.parent
FITTED = ['thesis-empty', 'thesis-modified', 'box-point', 'box-spheres', 'door-ajar', 'sun-glass', 'many-lights',
          'environment-map', 'lamp-in-glass', 'glossy-kitchen', 'textures', 'instances', 'lights-area', 'cornell-box']
# Point lights or beams by way of specular surfaces on what is seen in specular surfaces.
SDS = {'sun-glass', 'room-1', 'room-2'}
UNBIASED = ['bdpt', '-I', 'light_paths=1']
MERGING = ['vcm', '-I', 'light_paths=1', '-I', 'alpha=0.1']
GROUPS = 'path in groups'
FIXED = {'path': '`path`', GROUPS: '… in groups', 'bdpt': '`bdpt`', 'vcm': '`vcm`', 'ppm': '`ppm`'}  # columns
MITSUBA = 'Mitsuba'
TILES, MEAN_LIMIT, TILE_LIMIT, ERRORS, DARK = 8, 0.005, 0.02, 4, 0.05


def run(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def read(path):
    colours = mi.Bitmap(str(path)).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32)
    return np.array(colours).astype(float)


def size_of(name):
    provenance = ROOT / 'reference' / name / 'provenance.json'
    return json.loads(provenance.read_text())['size'] if provenance.exists() else [128, 128]


class Scene:
    def __init__(self, name, file, size, made=None):
        self.name, self.file, self.size, self.made = name, file, f'{size[0]}x{size[1]}', made
        self.fixed = list(FIXED)
        if '<medium' in Path(file).read_text():
            self.fixed = ['volpath', 'bdpt', 'vcm']

    def render(self, o, image, method, spp, seed, *more):
        return run([o.duet, 'render', str(self.file), '-q', '-i', *method, '--spp', str(spp), '--seed', str(seed),
                    '-t', str(o.threads), '--size', self.size, '-o', str(image), *more])

    def render_with_mitsuba(self, o, image, spp, seed):
        """CPU seconds of one more image."""
        command = [sys.executable, ROOT / 'bench/mitsuba_render.py', '--further', 'llvm_ad_rgb', self.file, image,
                   spp, seed, *self.size.split('x'), o.threads]
        return float(subprocess.run(list(map(str, command)), check=True, capture_output=True, text=True).stdout)

    def reference(self, o):
        """Mean, variance of the mean, and what made them."""
        folder = ROOT / 'reference' / self.name
        if (folder / 'mean.exr').exists():
            spp = json.loads((folder / 'provenance.json').read_text())['spp']
            return read(folder / 'mean.exr'), read(folder / 'variance.exr') / spp, 'Mitsuba'
        method = MERGING if self.name in SDS else UNBIASED
        o.references.mkdir(parents=True, exist_ok=True)
        halves = []
        for seed in (9001, 9002):
            file = o.references / f'{self.name}-{self.size}-{method[0]}-{o.reference_spp}-{seed}.exr'
            if not file.exists():
                self.render(o, file.with_suffix('.part.exr'), method, o.reference_spp, seed)
                file.with_suffix('.part.exr').rename(file)
            halves.append(read(file))
        return (halves[0] + halves[1]) / 2, (halves[0] - halves[1]) ** 2 / 4, 'vcm α=0.1' if method is MERGING else 'bdpt'


def fitted():
    return [Scene(n, ROOT / 'scenes' / n / 'scene.xml', size_of(n)) for n in FITTED]


def holdout(folder):
    return [Scene(made.name, made.write(folder), made.size, made.text) for made in holdout_scenes.make()]


def error(image, mean, variance):
    """Squared relative error without the worst pixels, the noise of the reference taken off."""
    scale = 1 / (mean ** 2 + 0.01)
    worst = ((image - mean) ** 2 * scale).mean(2).ravel().argsort()
    kept = worst[:worst.size - max(1, worst.size // 1000)]
    return (((image - mean) ** 2 - variance) * scale).mean(2).ravel()[kept].sum() / worst.size


def tiles(values):
    """Sums over 8 × 8 tiles and the colours."""
    h, w = values.shape[:2]
    rows, columns = np.arange(TILES) * h // TILES, np.arange(TILES) * w // TILES
    return np.add.reduceat(np.add.reduceat(values.sum(2), rows, 0), columns, 1)


def is_off(images, mean, variance):
    """Whether images are wrong by the one rule."""
    images = np.array(images)
    n = len(images)
    noise = images.var(0, ddof=1) / n if n > 1 else 0 * mean
    counts = tiles(np.ones_like(mean))
    by_tile, truth = np.array([tiles(i) / counts for i in images]), tiles(mean) / counts
    # Errors of neighbours are alike where photons are shared; so few rounds may agree by chance.
    pixels = 4 * tiles(noise) / counts ** 2
    rounds = by_tile.var(0, ddof=1) / n if n > 1 else 0
    deviation = np.sqrt(np.maximum(pixels, rounds) + tiles(variance) / counts ** 2)
    off = np.abs(by_tile.mean(0) - truth)
    if (off > ERRORS * deviation + TILE_LIMIT * np.maximum(truth, DARK * mean.mean())).any():
        return True
    means = images.mean((1, 2, 3))
    pixels = 4 * noise.sum() / noise.size ** 2
    rounds = means.var(ddof=1) / n if n > 1 else 0
    deviation = math.sqrt(max(pixels, rounds) + variance.sum() / variance.size ** 2)
    return abs(means.mean() - mean.mean()) > ERRORS * deviation + MEAN_LIMIT * mean.mean()


def judge(scene, o, folder):
    mean, variance, source = scene.reference(o)
    methods = scene.fixed + ['auto'] + [MITSUBA] * o.mitsuba
    efficiency, images, chosen = {m: [] for m in methods}, {m: [] for m in methods}, ''
    for r in range(o.rounds):
        for m in methods:
            image, stats = folder / 'image.exr', folder / 'stats.json'
            if m == MITSUBA:
                cpu = scene.render_with_mitsuba(o, image, o.spp, r + 1)
            else:
                method = ['path', '-I', 'pixel_group=16'] if m == GROUPS else [m]
                cpu = scene.render(o, image, method, o.spp, r + 1, '--stats', str(stats))
            if m == 'auto':
                chosen = json.loads(stats.read_text())['chosen']['reason'].split(':')[0]
            images[m].append(read(image))
            efficiency[m].append(1 / (max(error(images[m][-1], mean, variance), 1e-9) * cpu))
    first = scene.fixed[0]
    relative = {m: statistics.median(e / p for e, p in zip(efficiency[m], efficiency[first])) for m in methods}
    off = [m for m in methods if is_off(images[m], mean, variance)]
    counted = [relative[m] for m in scene.fixed if m not in off]
    best = 0 if 'auto' in off or not counted else relative['auto'] / max(counted)
    return {'relative': relative, 'efficiency': {m: statistics.median(e) for m, e in efficiency.items()}, 'off': off,
            'of_best': best, 'chosen': chosen, 'reference': source, 'scene': scene.made,
            'mean': {m: float(np.mean(images[m]) / mean.mean()) for m in methods},
            'confirmed': [m for m in scene.fixed if m not in off],
            'over_mitsuba': o.mitsuba and statistics.median(a / m for a, m in zip(efficiency['auto'], efficiency[MITSUBA]))}


def row(scene, t):
    mark = lambda m: f'{t["relative"][m]:.3g}' + '*' * (m in t['off'])
    columns = [m if m in scene.fixed else {'path': 'volpath'}.get(m) for m in FIXED]
    cells = [mark(m) if m in scene.fixed else '' for m in columns] + [mark('auto'), f'{t["of_best"]:.2f}']
    if t['over_mitsuba']:
        cells += [mark(MITSUBA), f'{t["over_mitsuba"]:.2f}']
    cells += [t['chosen'], f'{t["reference"]}: {", ".join(t["confirmed"]) or "none"}']
    return f'| {scene.name} | ' + ' | '.join(cells) + ' |'


def geometric_mean(values):
    return math.exp(statistics.mean(math.log(max(v, 1e-3)) for v in values))


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument('scenes', nargs='*')
    p.add_argument('--set', choices=['fitted', 'holdout'], default='fitted')
    p.add_argument('--duet', default=str(ROOT / 'build/duet'))
    p.add_argument('--rounds', type=int, default=3)
    p.add_argument('--spp', type=int, default=64)
    p.add_argument('--reference-spp', type=int, default=1024)
    p.add_argument('--threads', type=int, default=2)
    p.add_argument('--references', type=Path, default=Path.home() / '.cache/duet/auto')
    p.add_argument('--mitsuba', action='store_true')
    p.add_argument('--json', type=Path)
    o = p.parse_args()
    table = {}
    theirs = ['Mitsuba', '`auto` / it'] if o.mitsuba else []
    head = ['', *FIXED.values(), '`auto`', 'of the best', *theirs, '`auto` chose', 'reference, confirmed by']
    print('| ' + ' | '.join(head) + ' |')
    print('|---' * len(head) + '|')
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        for scene in fitted() if o.set == 'fitted' else holdout(folder):
            if o.scenes and scene.name not in o.scenes:
                continue
            t = table[scene.name] = judge(scene, o, folder)
            print(row(scene, t), flush=True)
            if o.json:
                o.json.write_text(json.dumps(table, indent=1) + '\n')
    shares = [t['of_best'] for t in table.values()]
    print(f'\nOf the best: geometric mean {geometric_mean(shares):.2f}, least {min(shares):.2f}. Against path in the geometric '
          f'mean: {geometric_mean([t["relative"]["auto"] for t in table.values()]):.2f}')
    if o.mitsuba:
        ratios = [t['over_mitsuba'] for t in table.values()]
        print(f'Against Mitsuba: geometric mean {geometric_mean(ratios):.2f}, least {min(ratios):.2f}')


if __name__ == '__main__':
    main()
