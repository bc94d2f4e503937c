"""scenes/gallery-materials: a table with vessels and balls. Returns its meshes and images by name. Needs numpy."""
import numpy as np

from . import textures
from .objects import plate, carafe, bowl, vase, plant, pot
from .shapes import ball, box, joined, lathe, placed, surface, tube, turn


def cloth(width, depth, cells=(72, 60)):
    """A runner that lies in soft folds."""
    x, y = np.meshgrid(np.linspace(-width / 2, width / 2, cells[0] + 1), np.linspace(-depth / 2, depth / 2, cells[1] + 1))
    edge = np.clip(np.hypot(x / (0.5 * width), y / (0.5 * depth)), 0, 1.4)
    fold = 0.5 + 0.5 * np.sin(17 * x + 5 * y + 1.2 * np.sin(7 * y))
    z = 0.0025 + 0.016 * fold ** 3 * np.clip(edge - 0.45, 0, 1)
    uvs = np.stack([x, y], axis=-1) * 12
    points = np.stack([x + 0.012 * np.sin(9 * y), y + 0.010 * np.sin(8 * x), z], axis=-1)
    return surface(points, uvs)


def knot(radius, thickness):
    """A trefoil knot of wire that lies flat."""
    t = np.linspace(0, 2 * np.pi, 121)
    path = radius / 3 * np.stack([np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -0.62 * np.sin(3 * t)], axis=-1)
    return placed(tube(path, thickness, 14, closed=True), (0, 0, thickness - path[:, 2].min()))


def lemon(length, centre, *turns):
    t = np.linspace(-1, 1, 15)
    radius = 0.62 * length / 2 * np.sqrt(np.clip(1 - np.abs(t) ** 2.3, 0, 1)) + 0.0001
    knots = np.stack([radius, length / 2 * t * (1 + 0.10 * t ** 8)], axis=-1)
    return placed(lathe([knots], 32, 2), centre, *turns)


def materials():
    parts = {'table': plate(2.4, 1.7, (0, 0.15, 0), (2, 2))}
    t = np.linspace(0, np.pi / 2, 12)
    curve = np.concatenate([[(0.94, 0)], np.stack([1.0 + 0.25 * np.sin(t), 0.25 - 0.25 * np.cos(t)], -1), [(1.25, 1.6)]])
    x = np.array([-2.6, 2.6])
    parts['backdrop'] = surface(np.stack([x + 0 * curve[:, :1], curve[:, :1] + 0 * x, curve[:, 1:] - 0.002 + 0 * x], axis=-1),
                                np.stack([x + 0 * curve[:, :1], np.arange(len(curve))[:, None] + 0 * x], axis=-1))
    parts['cloth'] = placed(cloth(1.05, 0.62), (-0.12, 0.02, 0), turn(-9))
    parts['glazed-vase'] = placed(vase(0.92), (-0.36, 0.20, 0.012))
    flutes = lambda angle, z: 1 + 0.05 * np.cos(12 * angle + 14 * z) * np.sin(np.pi * np.clip(z / 0.29, 0, 1))
    parts['gold-vase'] = placed(vase(0.80, 96, flutes), (0.30, 0.28, 0.010))
    parts['carafe'] = placed(carafe(), (0.03, 0.15, 0.010))
    parts['bowl'] = placed(bowl(0.135, 0.075), (-0.12, -0.10, 0.008))
    parts['lemons'] = joined(lemon(0.085, (-0.165, -0.10, 0.055), turn(80, 'x'), turn(30)),
                             lemon(0.082, (-0.085, -0.125, 0.055), turn(85, 'x'), turn(-50)),
                             lemon(0.080, (-0.115, -0.06, 0.085), turn(75, 'x'), turn(95)))
    parts['mirror-ball'] = ball(0.062, (0.22, -0.06, 0.072), 40)
    parts['paint-ball'] = ball(0.080, (0.46, 0.06, 0.081), 40)
    parts['rust-ball'] = ball(0.062, (-0.50, -0.04, 0.075), 40)
    parts['frosted-ball'] = ball(0.046, (0.10, -0.22, 0.058), 36)
    parts['block'] = placed(box((0.15, 0.15, 0.13), (0, 0, 0.066), 0.006), (0.61, 0.30, 0), turn(24))
    parts['jade-ball'] = ball(0.055, (0.61, 0.30, 0.186), 36)
    parts['knot'] = placed(knot(0.085, 0.012), (0.37, -0.19, 0), turn(15))
    parts['pot'] = placed(pot(0.095, 0.165), (-0.64, 0.30, 0))
    parts['plant'] = placed(plant(15, 12, 0.20), (-0.64, 0.30, 0.15))
    wood = textures.wood(512, 256, (0.20, 0.10, 0.05), (0.36, 0.20, 0.11), 8)
    return parts, {'wood.png': wood, 'glaze.png': textures.glaze(), 'weave.png': textures.weave(),
                   'rust.png': textures.rust(), 'stone.png': textures.stone()}
