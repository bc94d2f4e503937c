#!/usr/bin/env python3
"""Makes src/lights/sky_tables.cpp.

    make_sky_tables.py        needs the Python packages mitsuba (3.9.1) and numpy

Source: the data sets of Hosek and Wilkie's models of sky and sun, as the package mitsuba has them in data/sunsky, under
the licence that is repeated in the file made. The irradiance of the sun, given at 11 wavelengths, becomes linear sRGB.
"""
import struct
import subprocess
from pathlib import Path

import mitsuba as mi
import numpy as np

mi.set_variant('scalar_rgb')
DATA = Path(mi.__file__).parent / 'data' / 'sunsky'
TARGET = Path(__file__).resolve().parent.parent / 'src' / 'lights' / 'sky_tables.cpp'
# Mitsuba's RGB variants scale the sun so that it fits the sky's data, which are in units of their own.
SUN_SCALE = 467.069280386 / 106.7502593994140625
TO_SRGB = np.array([[3.240479, -1.537150, -0.498535], [-0.969256, 1.875991, 0.041556], [0.055648, -0.204043, 1.057311]])


def tensors(path):
    """The fields of a tensor file by name; they are 32- or 64-bit numbers."""
    data = path.read_bytes()
    at = 18
    fields = {}
    for _ in range(struct.unpack('<I', data[14:18])[0]):
        length, = struct.unpack('<H', data[at:at + 2])
        name = data[at + 2:at + 2 + length].decode()
        at += 2 + length
        dimensions, kind, offset = struct.unpack('<HBQ', data[at:at + 11])
        shape = struct.unpack(f'<{dimensions}Q', data[at + 11:at + 11 + 8 * dimensions])
        at += 11 + 8 * dimensions
        fields[name] = np.frombuffer(data, {10: '<f4', 11: '<f8'}[kind], int(np.prod(shape)), offset).reshape(shape)
    return fields


def sun_irradiance(spectra):
    wavelengths = np.arange(320, 721, 40)
    xyz = np.array([[0, 0, 0] if w < 360 else np.array(mi.cie1931_xyz(float(w))) for w in wavelengths])
    return spectra @ (xyz @ TO_SRGB.T) / len(wavelengths) * SUN_SCALE


def table(name, values):
    numbers = ', '.join(f'{v:.7g}f' if '.' in f'{v:.7g}' or 'e' in f'{v:.7g}' else f'{v:.7g}.0f'
                        for v in values.ravel())
    return f'const std::array<float, {values.size}> {name}{{{numbers}}};\n\n'


sky, sun = tensors(DATA / 'sunsky_datasets.bin'), tensors(DATA / 'sampling_data.bin')
licence = ''.join(f'// {line}'.rstrip() + '\n' for line in (DATA / 'LICENSE').read_text().splitlines())
TARGET.write_text(
    f'// Made by scripts/make_sky_tables.py from Mitsuba {mi.__version__}; do not edit. Source and licence of the data:\n//\n'
    + licence + '\n#include "lights/sky_tables.h"\n\nnamespace duet {\n\n// clang-format off\n'
    + table('kSkyShape', sky['sky_params_rgb']) + table('kSkyRadiance', sky['sky_rad_rgb'])
    + table('kSunIrradiance', sun_irradiance(sun['sun_irradiance'])) + '// clang-format on\n\n}  // namespace duet\n')
