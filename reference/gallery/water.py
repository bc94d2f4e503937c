"""scenes/gallery-water: a pool with waves. Returns its meshes and images by name. Needs numpy."""
import numpy as np

from . import textures
from .objects import plate, wall, carafe, plant, pot
from .shapes import box, grid_mesh, joined, placed, turn


def waves(x, y):
    """Height of the water: waves from a few places, short ones over long ones; metres."""
    z = 0.0
    for k, (cx, cy, length, height) in enumerate([(-2.6, 3.1, 0.62, 0.0056), (2.9, 2.2, 0.47, 0.0044), (0.6, 4.4, 0.36, 0.0030),
                                                  (-1.9, -1.6, 0.27, 0.0018), (2.2, -0.9, 0.20, 0.0008)]):
        z = z + height * np.sin(2 * np.pi * np.hypot(x - cx, y - cy) / length + 1.7 * k)
    return z


def water_surface(width, depth, centre, cells):
    """A grid of the waves with their normals."""
    x, y = np.meshgrid(np.linspace(-width / 2, width / 2, cells[0] + 1) + centre[0],
                       np.linspace(-depth / 2, depth / 2, cells[1] + 1) + centre[1])
    h = 1e-4
    slopes = (waves(x + h, y) - waves(x - h, y)) / (2 * h), (waves(x, y + h) - waves(x, y - h)) / (2 * h)
    normals = np.stack([-slopes[0], -slopes[1], 1 + 0 * x], axis=-1)
    return grid_mesh(np.stack([x, y, centre[2] + waves(x, y)], axis=-1), normals, np.stack([x, y], axis=-1))


def water():
    parts = {}
    level, floor = -0.10, -0.62
    wide, long, deep = 2.4, 1.8, -floor
    parts['water'] = water_surface(wide, long, (0, long / 2, level), (110, 82))
    parts['pool'] = joined(
        plate(wide, long, (0, long / 2, floor), (2, 1.5)), wall(wide, deep, (0, long, floor / 2), 0, (2, 0.5)),
        wall(wide, deep, (0, 0, floor / 2), 180, (2, 0.5)), wall(long, deep, (-wide / 2, long / 2, floor / 2), 90, (1.5, 0.5)),
        wall(long, deep, (wide / 2, long / 2, floor / 2), -90, (1.5, 0.5)))
    steps = [box((w, long - 0.002, h), (wide / 2 - 0.0005 - w / 2, long / 2, floor + h / 2), 0)
             for w, h in ((0.75, 0.13), (0.5, 0.26), (0.25, 0.39))]
    parts['steps'] = joined(*steps)
    parts['steps'][2][:] /= 1.2
    slabs = []
    for k in range(5):
        x = (k - 2) * 0.65
        slabs += [box((0.645, 0.645, 0.06), (x, -0.305, -0.03), 0), box((0.645, 0.495, 0.06), (x, long + 0.2275, -0.03), 0)]
    for side in (-1, 1):
        slabs += [box((0.44, 0.595, 0.06), (side * (wide / 2 + 0.20), 0.3025 + 0.5975 * k, -0.03), 0) for k in range(3)]
    parts['slabs'] = joined(*slabs)
    parts['slabs'][2][:] /= 0.65
    parts['walls'] = joined(box((3.4, 0.12, 0.75), (0, 2.345, 0.345), 0), box((0.12, 2.9, 0.75), (1.685, 0.90, 0.345), 0),
                            box((3.4, 0.18, 0.05), (0, 2.345, 0.745), 0), box((0.18, 2.9, 0.05), (1.685, 0.90, 0.745), 0))
    parts['dado'] = joined(wall(3.3, 0.36, (0, 2.28, 0.18), 0, (5.5, 0.6)), wall(2.9, 0.36, (1.62, 0.90, 0.18), -90, (4.833, 0.6)))
    parts['carafe'] = placed(carafe(), (0.26, -0.13, 0.0003))
    parts['pots'] = joined(placed(pot(0.17, 0.30), (-1.02, 2.03, 0)), placed(pot(0.12, 0.20), (-0.62, 2.10, 0)))
    parts['plants'] = joined(placed(plant(24, 8, 0.46), (-1.02, 2.03, 0.27)), placed(plant(16, 9, 0.26), (-0.62, 2.10, 0.18)))
    parts['towels'] = joined(*[box((0.42 - 0.01 * k, 0.30, 0.06), (0.95 + 0.006 * (-1) ** k, 2.06, 0.031 + 0.0605 * k), 0.028, 8)
                               for k in range(3)])
    return parts, {'mosaic.png': textures.mosaic(), 'stone.png': textures.stone()}
