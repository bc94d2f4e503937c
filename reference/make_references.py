#!/usr/bin/env python3
"""Renders the references of the scenes with Mitsuba 3: mean, variance and provenance.

    make_references.py [NAME...] [--error 0.01] [--minutes 30] [--pass-samples 4000000]

For each entry of REFERENCES (all, or those named) it renders passes of the scene's own integrator and
film with Mitsuba (llvm_ad_rgb, single precision) until the trimmed relative RMSE of the mean itself is
below --error or the time is up, and writes to reference/<name>/

    mean.exr          mean of all passes, summed in double precision, stored as 32-bit floats
    variance.exr      variance of one sample per pixel, as the spread of the passes shows it (half)
    provenance.json   Mitsuba's version, variant, scene, definitions, integrator, samples, seeds and
                      the error reached

Passes have different seeds and are independent, so their spread gives the variance also for filters
through which neighbouring pixels share samples. Needs mitsuba and numpy.
"""
import argparse
import json
import re
import time
from pathlib import Path

import mitsuba as mi
import numpy as np

mi.set_variant('llvm_ad_rgb')
mi.set_log_level(mi.LogLevel.Error)

ROOT = Path(__file__).resolve().parent.parent
FIRST_SEED = 1000
MIN_PASSES = 32         # for a variance worth the name
TRIM = 0.001            # share of the worst pixels left out of the error, as in `duet compare`

# name of the reference -> (scene folder, definitions)
REFERENCES = {name: (name, {}) for name in (
    'batch', 'bsdf-conductors', 'bsdf-dielectrics', 'bsdf-fibres', 'bsdf-measured', 'bsdf-plastics', 'bsdf-principled',
    'bsdf-wrappers', 'camera', 'curves', 'depth-of-field', 'directional-area', 'environment-map', 'hide-behind', 'hide-emitters',
    'instances', 'lights-area', 'lights-delta', 'lights-placed', 'media-boundaries', 'media-heterogeneous',
    'media-homogeneous', 'media-nested', 'media-phase', 'orthographic', 'sdf-grid', 'shapes', 'shapes-files', 'spectra',
    'sunsky', 'texture-slots', 'textures', 'two-versions')}
REFERENCES.update({name: (name, {'size': '128'}) for name in (
    'cornell-box', 'mesh-lumpy', 'thesis-empty', 'thesis-modified')})
REFERENCES.update({f'filters-{kind}': ('filters', {'filter': kind}) for kind in (
    'tent', 'gaussian', 'mitchell', 'catmullrom', 'lanczos')})


def trimmed_relative_rmse(mean, variance_of_mean):
    """Root of the mean relative variance over the pixels, without the worst TRIM of them."""
    relative = np.sort((variance_of_mean / (mean ** 2 + 0.01)).mean(axis=2).ravel())
    return float(np.sqrt(relative[:max(1, int(len(relative) * (1 - TRIM)))].mean()))


def render_reference(name, target, minutes, pass_samples):
    folder, definitions = REFERENCES[name]
    scene_file = ROOT / 'scenes' / folder / 'scene.xml'
    # Merging meshes, which "optimize" does, fails where only some are inside out.
    scene = mi.load_file(str(scene_file), optimize=False, **definitions)
    width, height = scene.sensors()[0].film().crop_size()
    spp = max(16, 2 ** int(np.log2(pass_samples / (width * height))))
    start, passes, total, squares = time.monotonic(), 0, 0.0, 0.0
    while True:
        image = np.array(mi.render(scene, spp=spp, seed=FIRST_SEED + passes))[..., :3].astype(np.float64)
        passes += 1
        total, squares = total + image, squares + image ** 2
        if passes < MIN_PASSES:
            continue
        mean = total / passes
        variance = np.maximum(squares / passes - mean ** 2, 0) * passes / (passes - 1)  # of one pass
        error = trimmed_relative_rmse(mean, variance / passes)
        if error < target or time.monotonic() - start > 60 * minutes:
            break
    out = ROOT / 'reference' / name
    out.mkdir(exist_ok=True)
    rgb = mi.Bitmap.PixelFormat.RGB
    image = mi.Bitmap(mean.astype(np.float32), rgb)
    image.metadata()['spp'] = spp * passes  # where `duet compare` looks for it
    image.write(str(out / 'mean.exr'))
    per_sample = np.clip(variance * spp, 0, 65504).astype(np.float32)
    mi.Bitmap(per_sample, rgb).convert(rgb, mi.Struct.Type.Float16, False).write(str(out / 'variance.exr'))
    provenance = {
        'renderer': 'Mitsuba', 'version': mi.__version__, 'variant': mi.variant(),
        'scene': f'scenes/{folder}/scene.xml', 'definitions': definitions,
        'integrator': re.search(r'<integrator type="(\w+)"', scene_file.read_text())[1],
        'spp': spp * passes, 'passes': passes, 'spp_per_pass': spp,
        'seeds': [FIRST_SEED, FIRST_SEED + passes - 1],
        'size': [int(width), int(height)],
        'trimmed_relative_rmse': round(error, 6), 'target': target,
        'made_by': 'reference/make_references.py'}
    (out / 'provenance.json').write_text(json.dumps(provenance, indent=1) + '\n')
    print(f'{name:20} {width}x{height} {passes * spp:8} spp  error {error:.4f}  '
          f'{time.monotonic() - start:.0f} s', flush=True)


def main():
    parser = argparse.ArgumentParser(description='Render the references with Mitsuba.')
    parser.add_argument('names', nargs='*', help='references to make (default: all)')
    parser.add_argument('--error', type=float, default=0.01, help='trimmed relative RMSE to reach')
    parser.add_argument('--minutes', type=float, default=30, help='time per reference')
    parser.add_argument('--pass-samples', type=float, default=4e6, help='samples of one pass')
    args = parser.parse_args()
    for name in args.names or REFERENCES:
        if name not in REFERENCES:
            parser.error(f'no reference {name}; there are: ' + ' '.join(REFERENCES))
        render_reference(name, args.error, args.minutes, args.pass_samples)


if __name__ == '__main__':
    main()
