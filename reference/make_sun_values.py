#!/usr/bin/env python3
"""Irradiance of the sun of Mitsuba 0.6, computed apart from Duet: reference/tables/sun_0x.json.

    make_sun_values.py        needs the Python packages mitsuba (3.9.1, for the colour matching functions) and numpy

Mitsuba 0.6 evaluates the model of Preetham, Shirley and Smits ("A Practical Analytic Model for Daylight", 1999) every 5 nm from
350 to 800 nm, takes it for linear in between, integrates it with the CIE 1931 functions over 360 to 830 nm, divides by the
integral of the second of them, and goes to linear sRGB without negative values. Here that is done by brute force in double
precision: all five kinds of absorption, tables as lists of wavelengths, and the trapezoidal rule in steps of 0.1 nm.
"""
import json
from pathlib import Path

import mitsuba as mi
import numpy as np

mi.set_variant('scalar_rgb')
TO_SRGB = np.array([[3.240479, -1.537150, -0.498535], [-0.969256, 1.875991, 0.041556], [0.055648, -0.204043, 1.057311]])
FINE = np.linspace(360, 830, 4701)
CIE = np.array([np.array(mi.cie1931_xyz(float(w))) for w in FINE])

# Wavelength in nm: W/(m² nm sr), and absorption per cm.
SUN = dict(zip(range(380, 751, 10), [
    16559.0, 16233.7, 21127.5, 25888.2, 25829.1, 24232.3, 26760.5, 29658.3, 30545.4, 30057.5, 30663.7, 28830.4, 28712.1, 27825.0,
    27100.6, 27233.6, 26361.3, 25503.8, 25060.2, 25311.6, 25355.9, 25134.2, 24631.5, 24173.2, 23685.3, 23212.1, 22827.7, 22339.8,
    21970.2, 21526.7, 21097.9, 20728.3, 20240.4, 19870.8, 19427.2, 19072.4, 18628.9, 18259.2]))
OZONE = dict(zip([*range(300, 356, 5), *range(445, 611, 5), *range(620, 791, 10)], [
    10, 4.8, 2.7, 1.35, .8, .38, .16, .075, .04, .019, .007, 0, .003, .003, .004, .006, .008, .009, .012, .014, .017, .021, .025,
    .03, .035, .04, .045, .048, .057, .063, .07, .075, .08, .085, .095, .103, .11, .12, .122, .12, .118, .115, .12, .125, .13,
    .12, .105, .09, .079, .067, .057, .048, .036, .028, .023, .018, .014, .011, .01, .009, .007, .004, 0, 0]))
GASES = {759: 0, 760: 3, 770: .21, 771: 0}
WATER = {689: 0, 690: .016, 700: .024, 710: .0125, 720: 1, 730: .87, 740: .061, 750: .001, 760: 1e-5, 770: 1e-5, 780: 6e-4,
         790: .0175, 800: .036}


def at(table, wavelengths):
    return np.interp(wavelengths, list(table), list(table.values()), left=0, right=0)


def irradiance(turbidity, elevation):
    """Linear sRGB of the sun's irradiance, and its integral over the wavelengths in W/m²."""
    theta = np.radians(90 - elevation)
    w = np.arange(350.0, 801, 5)
    mass = 1 / (np.cos(theta) + 0.15 * (93.885 - np.degrees(theta)) ** -1.253)
    rayleigh = np.exp(-mass * 0.008735 * (w / 1000) ** -4.08)
    aerosol = np.exp(-mass * (0.04608365822050 * turbidity - 0.04586025928522) * (w / 1000) ** -1.3)
    ozone = np.exp(-mass * at(OZONE, w) * 0.35)
    gases = np.exp(-1.41 * at(GASES, w) * mass / (1 + 118.93 * at(GASES, w) * mass) ** 0.45)
    water = np.exp(-0.2385 * at(WATER, w) * 2 * mass / (1 + 20.07 * at(WATER, w) * 2 * mass) ** 0.45)
    spectrum = at(SUN, w) * rayleigh * aerosol * ozone * gases * water
    xyz = np.trapezoid(CIE * np.interp(FINE, w, spectrum)[:, None], FINE, axis=0) / np.trapezoid(CIE[:, 1], FINE)
    solid_angle = 2 * np.pi * (1 - np.cos(np.radians(0.5358 / 2)))
    return np.maximum(TO_SRGB @ xyz, 0) * solid_angle, np.trapezoid(spectrum, w) * solid_angle


rows = []
for turbidity in (1, 2, 3, 4.5, 7, 10):
    for elevation in (1, 5, 15, 30, 46, 65, 90):
        rgb, watts = irradiance(turbidity, elevation)
        rows.append([turbidity, elevation, *(float(f'{x:.6g}') for x in (*rgb, watts))])
path = Path(__file__).parent / 'tables' / 'sun_0x.json'
lines = ',\n  '.join(json.dumps(row, separators=(',', ':')) for row in rows)
path.write_text('{\n"note": "made by make_sun_values.py; [turbidity, elevation in degrees, red, green, blue, W/m² from 350 to '
                f'800 nm]",\n"sun": [\n  {lines}\n]\n}}\n')
