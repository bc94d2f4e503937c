#!/usr/bin/env python3
"""What the features that a scene does not use cost it: a share of its instructions, and bytes per triangle.

    features.py --duet build-profile/duet [--size 48] [--spp 4] [--triangles 400000]

Time: scenes/thesis-empty (diffuse meshes under an area light) is rendered with path and bdpt under callgrind, which
counts the instructions of every source line, inlined or not. The lines that exist for the sake of a feature are known
by the folder of their file or by a pattern; a line that also does other work counts in full, so shares are upper bounds.
Start and end of the process, measured with fewer samples, are taken off. At most 2 % are allowed for each feature.

Memory: a mesh under a plain diffuse material, as a PLY file with and without normals and texture coordinates that the
scene does not use; the peak of the process may differ by at most a byte per triangle.

Exits with 1 if a limit is missed. Needs valgrind, numpy and a program with line numbers:

    cmake --preset release -B build-profile -DCMAKE_CXX_FLAGS=-g1 && cmake --build build-profile --target duet
"""
import argparse
import json
import re
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

from make_big_mesh import torus, write_ply

ROOT = Path(__file__).resolve().parent.parent
SCENE = ROOT / 'scenes' / 'thesis-empty' / 'scene.xml'
METHODS = ['path', 'bdpt']
LARGEST_SHARE, LARGEST_BYTES = 0.02, 1.0

# feature -> (pattern of files all of whose lines are for it, pattern of lines in other files)
FEATURES = {
    'participating media': (r'/media/|/volpath|media_vertex|shadow_transmittance', r'[mM]edi(um|a)\b|kMedia|shadow_transmittance'),
    'masks, null surfaces': (r'/null\.|/filter\.(cpp|h)$.*materials', r'\bmask|\bnull\b|outside_only'),
    'textures, coordinates': (r'/textures/', r'texture|\.uv\b|\bdp_d[uv]|tangent'),
    'bump and normal maps': (r'/tilt\.', r'bump|normal_map|tilt'),
    'instances': (r'$^', r'instance|instID'),
    'analytic shapes': (r'/analytic\.|/sdf_grid\.|/curves\.', r'analytic|sdf_grid|\bcurve'),
    'environments and skies': (r'/environment\.|/sky', r'[eE]nvironment'),
    'points, spots and beams': (r'lights/(delta|beam)\.', r'->delta|\bbeam|\.finite|->finite'),
    'lenses': (r'$^', r'\blens|has_lens'),
    'mirrors and glass': (r'/dielectric\.|/conductor\.|/thindielectric|/fresnel', r'\.eta\b|specular'),
    'layers and moments': (r'/layers\.', r'layer|moment'),
    'one-sided shading normals': (r'$^', r'strict_normals|sides_differ'),
    'merging of photons': (r'/vertex_grid', r'merge|photon'),
}


def lines_of(duet, method, size, spp, folder):
    """Instructions of each line of the sources: {(path, line): count}, and the total."""
    out = folder / 'callgrind.out'
    subprocess.run(['valgrind', '--tool=callgrind', f'--callgrind-out-file={out}', '--dump-line=yes', '--compress-pos=no',
                    '--compress-strings=no', duet, 'render', str(SCENE), '-q', '-t', '1', '-i', method, '-I', 'max_depth=8',
                    '--size', f'{size}x{size}', '--spp', str(spp), '-o', str(folder / 'image.exr')],
                   check=True, capture_output=True)
    counts, total, file, called = Counter(), 0, '', False
    for text in out.read_text(errors='replace').splitlines():
        if text.startswith(('fl=', 'fi=', 'fe=')):
            file = text[3:]
        elif text.startswith('calls='):
            called = True       # the next line has what the callee took
        elif text[:1].isdigit():
            if not called:
                line, cost = text.split()[:2]
                counts[file, int(line)] += int(cost)
                total += int(cost)
            called = False
    return counts, total


def shares(duet, method, size, spp, folder):
    """Per feature, its share of the instructions that further samples take."""
    more, all_of_more = lines_of(duet, method, size, spp, folder)
    less, all_of_less = lines_of(duet, method, size, spp // 2, folder)
    more.subtract(less)
    sources = {}

    def text(file, line):
        if file not in sources:
            path = Path(file) if Path(file).is_absolute() else ROOT / file
            sources[file] = path.read_text(errors='replace').splitlines() if path.exists() else []
        return sources[file][line - 1] if 0 < line <= len(sources[file]) else ''

    result = Counter()
    for (file, line), count in more.items():
        if '/src/' not in file and not file.startswith('src/'):
            continue
        for feature, (files, pattern) in FEATURES.items():
            if re.search(files, file) or re.search(pattern, text(file, line)):
                result[feature] += count
    return {f: result[f] / (all_of_more - all_of_less) for f in FEATURES}


def peak(duet, mesh, folder):
    scene, stats = folder / 'scene.xml', folder / 'stats.json'
    scene.write_text(f'<scene version="3.0.0"><sensor type="perspective"/><emitter type="constant"/>'
                     f'<shape type="ply"><string name="filename" value="{mesh}"/><boolean name="face_normals" '
                     f'value="true"/><bsdf type="diffuse"/></shape></scene>')
    subprocess.run([duet, 'render', str(scene), '-q', '-t', '1', '-i', 'path', '--size', '16x16', '--spp', '1', '-o',
                    str(folder / 'image.exr'), '--stats', str(stats)], check=True, capture_output=True)
    return json.loads(stats.read_text())['memory_peak_bytes']


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument('--duet', required=True)
    p.add_argument('--size', type=int, default=48)
    p.add_argument('--spp', type=int, default=4)
    p.add_argument('--triangles', type=int, default=400000)
    o = p.parse_args()
    missed = False
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        table = {m: shares(o.duet, m, o.size, o.spp, folder) for m in METHODS}
        print(f'{"share of instructions":28}' + ''.join(f'{m:>10}' for m in METHODS))
        for feature in FEATURES:
            print(f'{feature:28}' + ''.join(f'{100 * table[m][feature]:8.2f} %' for m in METHODS))
            missed |= any(table[m][feature] > LARGEST_SHARE for m in METHODS)
        positions, normals, faces = torus(o.triangles)
        turned = [(folder / 'plain.ply', None, None), (folder / 'full.ply', normals, positions[:, :2])]
        for path, n, uv in turned:
            write_ply(path, positions, n, faces, uv)
        bytes_more = (peak(o.duet, turned[1][0], folder) - peak(o.duet, turned[0][0], folder)) / len(faces)
        print(f'unused normals and texture coordinates: {bytes_more:.2f} bytes per triangle')
        missed |= bytes_more > LARGEST_BYTES
    sys.exit(1 if missed else 0)


if __name__ == '__main__':
    main()
