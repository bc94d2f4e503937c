#!/usr/bin/env python3
"""Makes parsers/values/color_tables.cpp, parsers/values/conductor_table.cpp and parsers/pbrt/metals.cpp.

    make_color_tables.py        needs the Python packages mitsuba (3.9.1), numpy and scipy

Sources and licences:
  - CIE 1931 2-degree colour matching functions and the CIE standard illuminant D65, 360 to 830 nm in steps of 5 nm:
    colorimetric data of the CIE (ISO/CIE 11664-1 and 11664-2), as tabulated by Mitsuba 3 (BSD-3-Clause).
  - Complex indices of refraction: the files data/ior/*.spd that come with Mitsuba (BSD-3-Clause), which name their own
    sources (luxpop.com, Palik, SOPRA). They are turned into linear sRGB by Mitsuba's RGB variant, and for pbrt-v4 into
    the three indices whose Fresnel reflectance is nearest to the colour that the metal has under D65.
"""
import re
import subprocess
from pathlib import Path

import mitsuba as mi
import numpy as np
from scipy.optimize import least_squares

mi.set_variant('scalar_rgb')
PARSERS = Path(__file__).resolve().parent.parent / 'parsers'
HEAD = '''// Made by scripts/make_color_tables.py from Mitsuba {version}; do not edit.
//
{source}
#include "{header}"

namespace duet {{
'''
CIE = '''// Source: colorimetric data of the CIE (ISO/CIE 11664-1 and 11664-2) as tabulated by Mitsuba 3, which is
// Copyright (c) Wenzel Jakob and others, BSD-3-Clause.
'''
IOR = '''// Source: the measurements data/ior/*.spd of Mitsuba, Copyright (c) Wenzel Jakob and others, BSD-3-Clause; the files name
// luxpop.com, Palik's handbook and the SOPRA database as theirs. Converted to linear sRGB by Mitsuba.
'''


def rows(values, per_line, form='{:.7g}'):
    words = [form.format(v) for v in values]
    lines = [', '.join(words[i:i + per_line]) for i in range(0, len(words), per_line)]
    return ',\n    '.join(lines)


def d65():
    """The table in the header spectrum.h; Python has no function for it."""
    header = Path(mi.__file__).parent / 'include/mitsuba/core/spectrum.h'
    table = re.search(r'd65_table\[MI_CIE_SAMPLES\] = \{(.*?)\}', header.read_text(), re.DOTALL)[1]
    return [float(v.rstrip('f')) for v in re.findall(r'[\d.]+f', table)]


def color_tables():
    wavelengths = np.arange(360, 831, 5)
    xyz = np.array([mi.cie1931_xyz(float(w)) for w in wavelengths])
    text = HEAD.format(version=mi.__version__, source=CIE, header='values/color_tables.h')
    for name, values in (('kCieX', xyz[:, 0]), ('kCieY', xyz[:, 1]), ('kCieZ', xyz[:, 2]), ('kD65', d65())):
        assert len(values) == len(wavelengths) == 95
        text += f'\nconst std::array<float, kCieSamples> {name}{{\n    {rows(values, 8)}}};\n'
    (PARSERS / 'values/color_tables.cpp').write_text(text + '\n}  // namespace duet\n')


def conductors():
    folder = Path(mi.__file__).parent / 'data/ior'
    names = sorted({f.name[:-len('.eta.spd')] for f in folder.glob('*.eta.spd')}, key=str)
    text = HEAD.format(version=mi.__version__, source=IOR, header='values/ior.h')
    text += '\nnamespace {\n\nconstexpr ConductorEntry kConductors[] = {\n'
    for name in names:
        bsdf = mi.load_dict({'type': 'conductor', 'material': name})
        values = mi.traverse(bsdf)
        eta, k = (', '.join(f'{v:.7g}' for v in np.array(values[key + '.value'], dtype=np.float64).ravel())
                  for key in ('eta', 'k'))
        text += f'    {{"{name}", {{{eta}}}, {{{k}}}}},\n'
    text += '};\n\n}  // namespace\n\nstd::span<const ConductorEntry> conductors() { return kConductors; }\n'
    (PARSERS / 'values/conductor_table.cpp').write_text(text + '\n}  // namespace duet\n')


def spectrum(path, wavelengths):
    """A measured index at the wavelengths, linear between samples."""
    lines = [line.split() for line in path.read_text().splitlines() if line.strip() and not line.startswith('#')]
    table = np.array(lines, float)
    return np.interp(wavelengths, table[:, 0], table[:, 1])


def fresnel(eta, k, cosine):
    """Reflectance of unpolarised light, cosines by indices (Born & Wolf, Principles of Optics, 14.4)."""
    c = np.asarray(cosine)[:, None]
    sin2 = 1 - c * c
    t0 = eta ** 2 - k ** 2 - sin2
    a2b2 = np.sqrt(t0 ** 2 + 4 * eta ** 2 * k ** 2)
    a = np.sqrt(np.maximum(0, (a2b2 + t0) / 2))
    rs = (a2b2 + c * c - 2 * c * a) / (a2b2 + c * c + 2 * c * a)
    rp = rs * ((c * c * a2b2 + sin2 ** 2 - 2 * c * a * sin2) / (c * c * a2b2 + sin2 ** 2 + 2 * c * a * sin2))
    return (rs + rp) / 2


def fitted_indices(eta, k, to_rgb):
    """Index and extinction per channel: least squares of the reflectance over angles, weighed by the cosine."""
    x, weights = np.polynomial.legendre.leggauss(16)
    cosine = (x + 1) / 2
    colour = fresnel(eta, k, cosine) @ to_rgb
    starts = [(0.2, 3), (1, 2.5), (0.05, 4), (1.7, 0.01), (1.5, 7), (2.6, 0.01)]
    best = []
    for channel in colour.T:
        def residual(p):
            return np.sqrt(weights * cosine) * (fresnel(p[:1], p[1:], cosine)[:, 0] - channel)
        fits = [least_squares(residual, start, bounds=([1e-4, 0], [20, 20])) for start in starts]
        best.append(min(fits, key=lambda fit: fit.cost).x)
    return np.array(best).T


def pbrt_metals():
    wavelengths = np.arange(360, 831, 5.0)
    xyz = np.array([np.array(mi.cie1931_xyz(float(w))).ravel() for w in wavelengths])
    from_xyz = np.array([[3.2404542, -1.5371385, -0.4985314], [-0.9692660, 1.8760108, 0.0415560],
                         [0.0556434, -0.2040259, 1.0572252]])
    to_rgb = (np.array(d65())[:, None] * xyz) @ from_xyz.T
    to_rgb /= to_rgb.sum(axis=0)
    folder = Path(mi.__file__).parent / 'data/ior'
    source = IOR.replace('Converted to linear sRGB by Mitsuba', 'Fitted to colours under D65')
    text = HEAD.format(version=mi.__version__, source=source, header='pbrt/metals.h')
    text = text.replace('namespace duet {', 'namespace duet::pbrt {')
    text += '\nnamespace {\n\nconstexpr Metal kMetals[] = {\n'
    for name in ('Ag', 'Al', 'Au', 'Cu', 'MgO', 'TiO2'):
        fit = fitted_indices(*(spectrum(folder / f'{name}.{part}.spd', wavelengths) for part in ('eta', 'k')), to_rgb)
        text += f'    {{"{name}", ' + ', '.join('{' + ', '.join(f'{v:.5g}' for v in row) + '}' for row in fit) + '},\n'
    text += '};\n\n}  // namespace\n\nstd::span<const Metal> measured_metals() { return kMetals; }\n'
    (PARSERS / 'pbrt/metals.cpp').write_text(text + '\n}  // namespace duet::pbrt\n')


color_tables()
conductors()
pbrt_metals()
for name in ('values/color_tables.cpp', 'values/conductor_table.cpp', 'pbrt/metals.cpp'):
    subprocess.run(['clang-format-14', '-i', str(PARSERS / name)], check=True)
