"""What more than one scene of the gallery has: plates, vessels, plants and pots. Lengths are metres. Needs numpy."""
import numpy as np

from .shapes import grid_mesh, joined, lathe, leaf, placed, turn


def plate(width, depth, centre, repeats=(1, 1), turns=()):
    """A flat rectangle that faces up, before it is turned."""
    x, y = np.meshgrid([-width / 2, width / 2], [-depth / 2, depth / 2])
    points = np.stack([x, y, 0 * x], axis=-1)
    uvs = np.stack([(x / width + 0.5) * repeats[0], (y / depth + 0.5) * repeats[1]], axis=-1)
    return placed(grid_mesh(points, np.broadcast_to([0.0, 0.0, 1.0], points.shape), uvs), centre, *turns)


def wall(width, height, centre, angle=0, repeats=(1, 1)):
    """An upright rectangle that faces −y, or what a turn by so many degrees makes of it."""
    return plate(width, height, centre, repeats, (turn(90, 'x'), turn(angle)))


def carafe(segments=64, wall=0.0035):
    """A carafe of thick glass; the origin is where it stands."""
    outer = [(0.045, 0.0), (0.062, 0.012), (0.072, 0.06), (0.062, 0.125), (0.034, 0.175), (0.026, 0.205), (0.030, 0.235),
             (0.040, 0.262)]
    inner = [(r - wall, z) for r, z in outer[:0:-1]]
    inner[-1] = (0.056, 0.020)
    return lathe([[(0, 0.0), outer[0]], outer, [outer[-1], (outer[-1][0] - wall / 2, 0.2645), inner[0]],
                  inner, [inner[-1], (0.040, 0.0125), (0.0, 0.011)]], segments, 5)


def bowl(radius=0.15, height=0.085, segments=64):
    """A thin bowl of metal on a foot."""
    r, h = radius, height
    outer = [(0.42 * r, 0.008), (0.68 * r, 0.18 * h), (0.90 * r, 0.52 * h), (r, h)]
    inner = [(0.985 * r, h), (0.875 * r, 0.54 * h), (0.66 * r, 0.24 * h), (0.0, 0.14 * h)]
    return lathe([[(0, 0), (0.42 * r, 0)], [(0.42 * r, 0), (0.42 * r, 0.008)], outer, [outer[-1], inner[0]], inner],
                 segments, 6)


def vase(scale=1.0, segments=64, ripple=None):
    """A vase with a narrow neck and a flared lip."""
    outer = [(0.050, 0.0), (0.085, 0.07), (0.104, 0.15), (0.085, 0.235), (0.042, 0.295), (0.033, 0.325), (0.053, 0.36)]
    inner = [(0.050, 0.36), (0.030, 0.325), (0.034, 0.30)]
    curves = [[(0, 0), (0.050, 0)], outer, [outer[-1], (0.052, 0.3625), inner[0]], inner, [inner[-1], (0, 0.29)]]
    curves = [[(scale * r, scale * z) for r, z in curve] for curve in curves]
    return lathe(curves, segments, 6, ripple)


def plant(count, seed, length=0.34):
    """Arching leaves from one place."""
    random = np.random.default_rng(seed)
    leaves = []
    for k in range(count):
        angle = 360 * k * 0.381966 + random.uniform(-12, 12)
        steep = random.uniform(0.5, 1.6)
        leaves.append(placed(leaf(length * random.uniform(0.7, 1.1), 0.11 * length * random.uniform(0.8, 1.2),
                                  length * steep, length * steep * random.uniform(0.25, 0.75)),
                             (0, 0, 0.01 * random.uniform()), turn(random.uniform(-20, 20), 'x'), turn(angle)))
    return joined(*leaves)


def pot(radius, height, segments=160):
    r, h = radius, height
    return lathe([[(0, 0), (0.72 * r, 0)], [(0.72 * r, 0), (0.93 * r, 0.82 * h)], [(0.93 * r, 0.82 * h), (r, 0.82 * h)],
                  [(r, 0.82 * h), (r, h)], [(r, h), (0.88 * r, h)], [(0.88 * r, h), (0.86 * r, 0.9 * h)]], segments, 4)
