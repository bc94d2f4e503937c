#!/usr/bin/env python3
"""Writes a scene with a medium given on a grid, for Duet and Mitsuba 3 alike.

    make_grid_medium.py FOLDER [--side 128]

FOLDER/scene.xml is a cloud of side³ densities (FOLDER/density.vol, version 3, float32) in a cube with a null BSDF over a
diffuse floor, under a constant environment and an area light, at 512×512 with volpath. It is the same at each call.
Needs numpy.
"""
import argparse
import struct
from pathlib import Path

import numpy as np

SCENE = '''<scene version="3.0.0">
  <integrator type="volpath"><integer name="max_depth" value="32"/></integrator>
  <sensor type="perspective">
    <float name="fov" value="40"/>
    <transform name="to_world"><lookat origin="0, -4.5, 1.6" target="0, 0, 0.9" up="0, 0, 1"/></transform>
    <film type="hdrfilm">
      <integer name="width" value="512"/><integer name="height" value="512"/><rfilter type="box"/>
    </film>
  </sensor>
  <shape type="rectangle">
    <transform name="to_world"><scale value="4"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0.5, 0.4, 0.3"/></bsdf>
  </shape>
  <shape type="cube">
    <transform name="to_world"><translate z="1.05"/></transform>
    <bsdf type="null"/>
    <medium type="heterogeneous" name="interior">
      <volume name="sigma_t" type="gridvolume">
        <string name="filename" value="density.vol"/>
        <transform name="to_world"><translate x="-0.5" y="-0.5" z="-0.5"/><scale value="2"/><translate z="1.05"/></transform>
      </volume>
      <float name="albedo" value="0.9"/>
      <float name="scale" value="12"/>
      <phase type="hg"><float name="g" value="0.5"/></phase>
    </medium>
  </shape>
  <shape type="rectangle">
    <transform name="to_world"><scale value="0.5"/><rotate x="1" angle="180"/><translate z="3.5"/></transform>
    <emitter type="area"><rgb name="radiance" value="20"/></emitter>
  </shape>
  <emitter type="constant"><rgb name="radiance" value="0.3, 0.4, 0.5"/></emitter>
</scene>
'''


def density(side):
    """A ball with waves on it, float32, [z][y][x]."""
    at = (np.arange(side) + 0.5) / side * 2 - 1
    z, y, x = np.meshgrid(at, at, at, indexing='ij')
    waves = np.sin(9 * x + 2 * y) * np.sin(8 * y - 3 * z) * np.sin(7 * z + 4 * x)
    return np.clip(1.2 * (0.85 - np.sqrt(x * x + y * y + z * z)) + 0.5 * waves, 0, 1).astype(np.float32)


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument('folder', type=Path)
    p.add_argument('--side', type=int, default=128)
    o = p.parse_args()
    o.folder.mkdir(parents=True, exist_ok=True)
    header = b'VOL' + struct.pack('<B5i6f', 3, 1, o.side, o.side, o.side, 1, 0, 0, 0, 1, 1, 1)
    (o.folder / 'density.vol').write_bytes(header + density(o.side).tobytes())
    (o.folder / 'scene.xml').write_text(SCENE)


if __name__ == '__main__':
    main()
