#!/usr/bin/env python3
"""Writes a room of 6 × 5 × 3 m with two windows, on a plain under a sky, as a file of Mitsuba 3.

    window_room.py [--plain 60] [--sun] FILE

--plain is half the side of the plain in metres; --sun adds a sun that shines in. For comparisons of light samples that
know where the sky is seen (docs/lights.md) with those that do not (--light-selection power). Needs numpy.
"""
import argparse
from pathlib import Path

from interiors import HEAD, diffuse, plastic, rgb

WALL, RED, BLUE, GRASS = (diffuse(rgb('reflectance', *c))
                          for c in ((.75, .73, .7), (.6, .2, .2), (.2, .4, .6), (.3, .35, .25)))
WOOD = plastic(rgb('reflectance', .4, .25, .15), .1)
METAL = '<bsdf type="roughconductor"><float name="alpha" value="0.15"/></bsdf>'
# Half the sides of a box, its centre, its material and its turn about z.
BOXES = [((3, 2.5, .05), (0, 0, -.05), WOOD, 0), ((3.1, 2.6, .05), (0, 0, 3.05), WALL, 0),
         ((.05, 2.5, 1.5), (-3.05, 0, 1.5), RED, 0), ((.05, 2.5, 1.5), (3.05, 0, 1.5), BLUE, 0),
         ((3.1, .05, 1.5), (0, -2.55, 1.5), WALL, 0),
         # Around the windows.
         ((3.1, .05, .5), (0, 2.55, .5), WALL, 0), ((3.1, .05, .4), (0, 2.55, 2.6), WALL, 0),
         ((.5, .05, .6), (-2.5, 2.55, 1.6), WALL, 0), ((1, .05, .6), (0, 2.55, 1.6), WALL, 0),
         ((.5, .05, .6), (2.5, 2.55, 1.6), WALL, 0),
         ((.6, .4, .4), (-1, .5, .4), WALL, 30), ((.3, .3, .8), (1.2, .8, .8), METAL, 15)]
SKY = '<emitter type="constant"><rgb name="radiance" value="0.8,1,1.3"/></emitter>\n'
SUN = """<emitter type="directional"><vector name="direction" x="0.5" y="-0.7" z="-0.6"/>
<rgb name="irradiance" value="12,11,9"/></emitter>
"""


def box(half, at, bsdf, turn):
    scale, translate = (' '.join(f'{k}="{v}"' for k, v in zip('xyz', values)) for values in (half, at))
    return (f'<shape type="cube"><transform name="to_world"><scale {scale}/><rotate z="1" angle="{turn}"/>'
            f'<translate {translate}/></transform>{bsdf}</shape>\n')


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument('file', type=Path)
    p.add_argument('--plain', type=float, default=60)
    p.add_argument('--sun', action='store_true')
    o = p.parse_args()
    ball = ('<shape type="sphere"><point name="center" x="0.3" y="-0.3" z="0.4"/><float name="radius" value="0.4"/>'
            f'{WOOD}</shape>\n')
    plain = (f'<shape type="rectangle"><transform name="to_world"><scale x="{o.plain}" y="{o.plain}"/>'
             f'<translate z="-0.2"/></transform>{GRASS}</shape>\n')
    head = HEAD.format(depth=10, fov=70, origin='-0.4,-2.3,1.5', target='0.3,1,1.1')
    o.file.write_text(head + SKY + SUN * o.sun + ''.join(box(*b) for b in BOXES) + ball + plain + '</scene>\n')


if __name__ == '__main__':
    main()
