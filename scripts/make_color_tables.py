#!/usr/bin/env python3
"""Makes parsers/values/color_tables.cpp and parsers/values/conductor_table.cpp.

    make_color_tables.py        needs the Python packages mitsuba (3.9.1) and numpy

Sources and licences:
  - CIE 1931 2-degree colour matching functions and the CIE standard illuminant D65, 360 to 830 nm in steps of 5 nm:
    colorimetric data of the CIE (ISO/CIE 11664-1 and 11664-2), as tabulated by Mitsuba 3 (BSD-3-Clause).
  - Complex indices of refraction: the files data/ior/*.spd that come with Mitsuba (BSD-3-Clause), which name their own
    sources (luxpop.com, Palik, SOPRA). They are turned into linear sRGB by Mitsuba's RGB variant.
"""
import re
import subprocess
from pathlib import Path

import mitsuba as mi
import numpy as np

mi.set_variant('scalar_rgb')
TARGET = Path(__file__).resolve().parent.parent / 'parsers' / 'mitsuba'
HEAD = '''// Made by scripts/make_color_tables.py from Mitsuba {version}; do not edit.
//
{source}
#include "mitsuba/{header}"

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
    text = HEAD.format(version=mi.__version__, source=CIE, header='color_tables.h')
    for name, values in (('kCieX', xyz[:, 0]), ('kCieY', xyz[:, 1]), ('kCieZ', xyz[:, 2]), ('kD65', d65())):
        assert len(values) == len(wavelengths) == 95
        text += f'\nconst std::array<float, kCieSamples> {name}{{\n    {rows(values, 8)}}};\n'
    (TARGET / 'color_tables.cpp').write_text(text + '\n}  // namespace duet\n')


def conductors():
    folder = Path(mi.__file__).parent / 'data/ior'
    names = sorted({f.name[:-len('.eta.spd')] for f in folder.glob('*.eta.spd')}, key=str)
    text = HEAD.format(version=mi.__version__, source=IOR, header='ior.h')
    text += '\nnamespace {\n\nconstexpr ConductorEntry kConductors[] = {\n'
    for name in names:
        bsdf = mi.load_dict({'type': 'conductor', 'material': name})
        values = mi.traverse(bsdf)
        eta, k = (', '.join(f'{v:.7g}' for v in np.array(values[key + '.value'], dtype=np.float64).ravel())
                  for key in ('eta', 'k'))
        text += f'    {{"{name}", {{{eta}}}, {{{k}}}}},\n'
    text += '};\n\n}  // namespace\n\nstd::span<const ConductorEntry> conductors() { return kConductors; }\n'
    (TARGET / 'conductor_table.cpp').write_text(text + '\n}  // namespace duet\n')


color_tables()
conductors()
for name in ('color_tables.cpp', 'conductor_table.cpp'):
    subprocess.run(['clang-format-14', '-i', str(TARGET / name)], check=True)
