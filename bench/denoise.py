#!/usr/bin/env python3
"""What `--denoise` does to the error: relMSE before and after, for several numbers of samples.

    denoise.py [--duet build/duet] [--spp 16,1024] [SCENE...]

Renders scenes that have references, in their sizes, with `--denoise` and compares both images with the reference
(`relmse` of docs/figures.md). Asked for are an error at least four times lower on eight of ten scenes with 16 samples per
pixel, and none that is higher with 1,024. The noise of the reference is part of every figure: where both errors are near
it, the ratio is near 1. Needs Open Image Denoise (DUET_OIDN_LIBRARY).
"""
import argparse
import json
import subprocess
import tempfile
from pathlib import Path

from auto import ROOT, size_of

SCENES = ['cornell-box', 'thesis-empty', 'thesis-modified', 'bsdf-conductors', 'bsdf-dielectrics', 'bsdf-plastics',
          'bsdf-principled', 'lights-area', 'textures', 'depth-of-field']


def figures(duet, image, reference):
    """The figures of an image, as `duet compare` has them."""
    done = subprocess.run([duet, 'compare', str(image), str(reference), '--json'], check=True, capture_output=True)
    return json.loads(done.stdout)


def render(duet, name, spp, folder):
    """relMSE of the image and of the denoised one."""
    image = Path(folder) / 'image.exr'
    reference = ROOT / 'reference' / name / 'mean.exr'
    width, height = size_of(name)
    subprocess.run([duet, str(ROOT / 'scenes' / name / 'scene.xml'), '-q', '--spp', str(spp), '--size',
                    f'{width}x{height}', '-o', str(image), '--denoise'], check=True)
    return [figures(duet, path, reference)['relmse'] for path in (image, image.with_suffix('.denoised.exr'))]


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument('scenes', nargs='*', default=SCENES)
    p.add_argument('--duet', default=str(ROOT / 'build/duet'))
    p.add_argument('--spp', default='16,1024')
    o = p.parse_args()
    print(f'{"scene":18}{"spp":>6}{"noisy":>12}{"denoised":>12}{"ratio":>8}')
    for spp in [int(s) for s in o.spp.split(',')]:
        ratios = []
        for name in o.scenes:
            with tempfile.TemporaryDirectory() as folder:
                noisy, denoised = render(o.duet, name, spp, folder)
            ratios.append(noisy / denoised)
            print(f'{name:18}{spp:6}{noisy:12.3e}{denoised:12.3e}{ratios[-1]:8.2f}', flush=True)
        print(f'{spp} spp: {sum(r >= 4 for r in ratios)} of {len(ratios)} at least 4 times lower, '
              f'{sum(r < 1 for r in ratios)} higher')


if __name__ == '__main__':
    main()
