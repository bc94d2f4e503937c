"""scenes/gallery-fog: a street with lamps. Returns its meshes and images by name. Needs numpy."""
import numpy as np

from . import textures
from .objects import plate
from .shapes import box, joined, lathe, placed, tube, turn


def lamp_post(height=3.6):
    """A post with an arm towards −x and a shade at its end, 0.75 from the post."""
    top = height - 0.35
    post = lathe([[(0, 0), (0.11, 0)], [(0.11, 0), (0.10, 0.25), (0.055, 0.42), (0.045, 1.2), (0.036, top)], [(0.036, top), (0, top)]], 48, 4)
    t = np.linspace(0, np.pi / 2, 9)
    bend = np.stack([-0.6 * (1 - np.cos(t)), 0 * t, height - 0.35 + 0.35 * np.sin(t)], -1)
    arm = tube(np.concatenate([[(0, 0, height - 0.5)], bend, [(-0.75, 0, height)]]), 0.024, 24)
    shade = lathe([[(0.27, -0.16), (0.255, -0.08), (0.17, 0.02), (0.06, 0.09), (0.05, 0.16)], [(0.05, 0.16), (0, 0.16)]], 96, 4)
    inner = lathe([[(0.0, 0.06), (0.055, 0.055), (0.165, -0.005), (0.25, -0.09), (0.265, -0.16)], [(0.265, -0.16), (0.27, -0.16)]], 96, 4)
    return joined(post, arm, placed(joined(shade, inner), (-0.75, 0, height - 0.10)))


def bench():
    parts = [box((1.5, 0.075, 0.035), (0, -0.16 + 0.09 * k, 0.45), 0) for k in range(5)]
    parts += [placed(box((1.5, 0.035, 0.085), (0, 0.27 + 0.03 * k, 0.60 + 0.12 * k), 0)) for k in range(3)]
    for x in (-0.6, 0.6):
        parts += [box((0.05, 0.05, 0.44), (x, -0.14, 0.22), 0), placed(box((0.05, 0.05, 0.95), (0, 0, 0.475), 0), (x, 0.20, 0), turn(-9, 'x')),
                  box((0.05, 0.40, 0.05), (x, 0.02, 0.41), 0)]
    return joined(*parts)


def tree(seed, height=6.5):
    """A bare tree: each branch ends in two or three that are shorter and thinner."""
    random = np.random.default_rng(seed)
    parts = []

    def grow(start, direction, length, radius, depth):
        bend = random.normal(0, 0.10, 3)
        t = np.linspace(0, 1, 5)[:, None]
        path = start + direction * length * t + bend * length * t ** 2
        parts.append(tube(path, radius * (1 - 0.32 * t[:, 0]), 8 if depth < 2 else 5))
        if depth == 6:
            return
        for _ in range(3 if depth in (0, 1) else 2):
            turned = direction + random.normal(0, 0.42, 3) + [0, 0, 0.10]
            grow(path[-1], turned / np.linalg.norm(turned), length * random.uniform(0.66, 0.84), 0.66 * radius, depth + 1)

    grow(np.zeros(3), np.array([0.03, 0.02, 1.0]), height * 0.30, height * 0.026, 0)
    return joined(*parts)


def house(width, depth, height, centre, sign, storeys, lit):
    """Walls, trim, dark panes and lit panes of a house whose front looks along `sign` · x; `centre` is on the ground."""
    x0 = centre[0] + sign * depth / 2
    walls = [box((depth, width, height), (centre[0], centre[1], height / 2), 0)]
    for mesh in walls:
        mesh[2][:] = np.stack([mesh[0][:, 0] + mesh[0][:, 1], mesh[0][:, 2]], axis=-1) / 0.9
    trim, dark, bright = [box((depth + 0.3, width + 0.04, 0.18), (centre[0], centre[1], height + 0.05), 0),
                          box((depth + 0.08, width + 0.02, 0.5), (centre[0], centre[1], 0.25), 0)], [], []
    columns = int(width / 1.5)
    for storey in range(storeys):
        for k in range(columns):
            y, z = centre[1] + (k - (columns - 1) / 2) * width / columns, 1.75 + 2.5 * storey
            if storey == 0 and k == 0:
                trim.append(box((0.08, 1.0, 2.3), (x0, y, 1.15), 0))
                continue
            pane = plate(0.86, 1.36, (x0 + sign * 0.012, y, z), turns=(turn(90, 'x'), turn(90 * sign)))
            (bright if (storey, k) in lit else dark).append(pane)
            trim += [box((0.10, 1.06, 0.09), (x0, y, z - 0.75), 0), box((0.08, 1.06, 0.10), (x0, y, z + 0.75), 0),
                     box((0.06, 0.05, 1.4), (x0, y, z), 0), box((0.06, 0.9, 0.045), (x0, y, z + 0.12), 0)]
            trim += [box((0.07, 0.06, 1.5), (x0, y + side * 0.46, z), 0) for side in (-1, 1)]
    return walls, trim, dark, bright


def fog():
    parts = {}
    walls, trim, dark, bright = [], [], [], []
    for row in (house(6.0, 4, 6.2, (-6.2, 1.0, 0), 1, 2, {(1, 2)}), house(7.5, 4, 8.4, (-6.0, 8.2, 0), 1, 3, {(0, 3), (2, 1)}),
                house(6.0, 4, 6.6, (-6.3, 15.4, 0), 1, 2, {(1, 1)}), house(8.0, 4, 8.0, (-6.0, 22.8, 0), 1, 3, set()),
                house(7.5, 4, 8.2, (6.2, 3.6, 0), -1, 3, {(1, 1), (0, 2)}), house(6.0, 4, 6.2, (6.0, 10.8, 0), -1, 2, {(1, 0)}),
                house(7.5, 4, 8.6, (6.3, 18.0, 0), -1, 3, {(1, 3)}), house(7.0, 4, 6.6, (6.0, 25.6, 0), -1, 2, set())):
        for group, more in zip((walls, trim, dark, bright), row):
            group += more
    for side in (-1, 1):
        trim.append(box((0.22, 34, 0.13), (side * 2.45, 12, 0.065), 0))
    parts['houses'], parts['trim'], parts['panes'], parts['lit-panes'] = joined(*walls), joined(*trim), joined(*dark), joined(*bright)
    parts['road'] = plate(4.9, 34, (0, 12, 0), (4, 28))
    parts['pavement'] = joined(*[plate(2.0, 34, (side * 3.4, 12, 0.12), (2, 34)) for side in (-1, 1)])
    parts['posts'] = joined(*[placed(lamp_post(), (2.75, y, 0.12)) for y in (5.2, 12.2, 19.2)],
                            *[placed(lamp_post(), (-2.75, y, 0.12), turn(180)) for y in (8.7, 15.7)])
    parts['bench'] = placed(bench(), (3.40, 6.1, 0.12), turn(-90))
    parts['tree'] = placed(tree(5), (-3.0, 6.0, 0.12))
    colours, heights = textures.cobbles()
    return parts, {'cobbles.png': colours, 'bricks.png': textures.bricks(), 'stone.png': textures.stone()}
