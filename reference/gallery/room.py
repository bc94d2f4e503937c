"""scenes/gallery-room: a room with a door ajar. Returns its meshes and images by name. Needs numpy."""
import numpy as np

from . import textures
from .objects import plate, wall, carafe, bowl, vase, plant, pot
from .shapes import ball, box, joined, lathe, placed, smooth, tube, turn


def frame_of_door(left, right, top, y, side):
    """A casing about an opening, on one side of a wall; `side` is −1 or 1."""
    w, d = 0.09, 0.03
    at = y + side * d / 2
    return joined(box((w, d, top + w), (left - w / 2, at, (top + w) / 2)), box((w, d, top + w), (right + w / 2, at, (top + w) / 2)),
                  box((right - left, d, w), ((left + right) / 2, at, top + w / 2)))


def door_leaf(width, height):
    """A door with four panels, hinged at x = 0, closed along −x; its face is at y = 0."""
    t, rail = 0.042, 0.11
    parts = [box((width - 0.01, 0.016, height - 0.02), (-width / 2, 0, height / 2))]
    for x in (-rail / 2, -width / 2, -width + rail / 2):
        parts.append(box((rail, t, height), (x, 0, height / 2), 0.006))
    for z in (rail, 0.95, height - rail / 2):
        for side in (0, 1):
            span = (width - 3 * rail) / 2
            parts.append(box((span + 0.004, t, 2 * rail if z < 0.2 else rail), (-rail * (1 + side) - span * (0.5 + side), 0, z), 0.006))
    return joined(*parts)


def door_handle(width):
    parts = []
    for side in (-1, 1):
        y = 0.021 * side
        rose = placed(lathe([[(0, 0), (0.026, 0)], [(0.026, 0), (0.024, 0.008), (0.01, 0.012)], [(0.010, 0.012), (0, 0.012)]], 32),
                      (0, 0, 0), turn(-90 * side, 'x'))
        parts.append(placed(rose, (-width + 0.06, y, 1.04)))
        lever = smooth(np.array([(0, 0.0, 0), (0, 0.045, 0), (0.012, 0.058, 0), (0.05, 0.060, 0), (0.125, 0.058, -0.004)]) * [1, side, 1], 5)
        parts.append(placed(tube(lever, 0.009, 20), (-width + 0.06, y, 1.04)))
    return joined(*parts)


def chair():
    """A plain wooden chair that looks along −y."""
    parts = [box((0.44, 0.43, 0.035), (0, 0, 0.45), 0.012)]
    for x in (-0.19, 0.19):
        parts.append(box((0.036, 0.036, 0.44), (x, -0.18, 0.22), 0.006))
        parts.append(placed(box((0.036, 0.036, 0.96), (0, 0, 0.48), 0.006), (x, 0.19, 0), turn(-5, 'x')))
        parts.append(box((0.022, 0.34, 0.03), (x, 0, 0.2), 0.005))
    for z in (0.62, 0.74, 0.86):
        parts.append(box((0.36, 0.018, 0.065), (0, 0.19 + z * np.tan(np.radians(5)), z), 0.007))
    parts.append(box((0.36, 0.022, 0.03), (0, -0.18, 0.24), 0.005))
    return joined(*parts)


def round_table(radius=0.46, height=0.74):
    top = [[(0, height - 0.03), (radius - 0.01, height - 0.03)],
           [(radius - 0.01, height - 0.03), (radius, height - 0.015), (radius - 0.01, height)], [(radius - 0.01, height), (0, height)]]
    stem = [[(0, 0.05), (0.05, 0.05)], [(0.05, 0.05), (0.060, 0.12), (0.034, 0.22), (0.030, 0.40), (0.046, 0.55), (0.032, 0.62), (0.075, 0.71)],
            [(0.075, 0.71), (0, 0.71)]]
    feet = [placed(tube([(0.02, 0, 0.13), (0.16, 0, 0.11), (0.27, 0, 0.05), (0.34, 0, 0.018)], [0.03, 0.026, 0.021, 0.018], 12), (0, 0, 0),
                   turn(120 * k + 25)) for k in range(3)]
    flat = lathe(top, 64, 4)
    flat[2][:] = flat[0][:, :2] / 0.8 + 0.5
    return joined(flat, lathe(stem, 40, 5), *feet)


def books(seed, width, colours):
    """A row of books, their backs at y = 0, sorted by colour."""
    random = np.random.default_rng(seed)
    rows, x = [[] for _ in range(colours)], 0.0
    while x < width - 0.05:
        thick, tall = random.uniform(0.018, 0.045), random.uniform(0.19, 0.27)
        lean = 0 if random.uniform() < 0.9 else 6
        book = box((thick, 0.15, tall), (thick / 2, 0.075 + random.uniform(0, 0.015), tall / 2), 0.003, 1)
        rows[random.integers(colours)].append(placed(book, (x, 0, 0), turn(lean, 'y')))
        x += thick + 0.0015 + (0.028 if lean else 0)
    return [joined(*row) for row in rows]


def shell():
    """What does not move: walls, floor, passage and painted wood, with a door that is open by 50 degrees."""
    parts = {
        'walls': joined(wall(2.55, 2.7, (-0.925, 2.0, 1.35)), wall(0.95, 2.7, (1.725, 2.0, 1.35)),
                        wall(0.9, 0.63, (0.8, 2.0, 2.385)), wall(4.6, 2.7, (-2.2, -0.3, 1.35), 90),
                        wall(4.6, 2.7, (2.2, -0.3, 1.35), -90), wall(4.4, 2.7, (0, -2.6, 1.35), 180)),
        'ceiling': plate(4.4, 4.6, (0, -0.3, 2.7), turns=(turn(180, 'x'),)),
        'floor': plate(4.4, 6.8, (0, 0.8, 0), (2.4, 3.7)),
        # With the reveal of the opening.
        'passage': joined(
            wall(2.55, 2.7, (-0.925, 2.12, 1.35), 180), wall(0.95, 2.7, (1.725, 2.12, 1.35), 180),
            wall(0.9, 0.63, (0.8, 2.12, 2.385), 180), wall(4.4, 2.7, (0, 4.2, 1.35)), wall(2.08, 2.7, (-2.2, 3.16, 1.35), 90),
            wall(2.08, 2.7, (2.2, 3.16, 1.35), -90), plate(4.4, 2.08, (0, 3.16, 2.7), turns=(turn(180, 'x'),)),
            wall(0.12, 2.07, (0.35, 2.06, 1.035), 90), wall(0.12, 2.07, (1.25, 2.06, 1.035), -90),
            plate(0.9, 0.12, (0.8, 2.06, 2.07), turns=(turn(180, 'x'),)))}
    skirting = [box((2.46, 0.016, 0.11), (-0.97, 1.992, 0.055)), box((0.86, 0.016, 0.11), (1.77, 1.992, 0.055)),
                box((0.016, 4.6, 0.11), (-2.192, -0.3, 0.055)), box((0.016, 4.6, 0.11), (2.192, -0.3, 0.055)),
                box((4.4, 0.05, 0.07), (0, 1.98, 2.66), 0.02), box((0.05, 4.6, 0.07), (-2.18, -0.3, 2.66), 0.02),
                box((0.05, 4.6, 0.07), (2.18, -0.3, 2.66), 0.02), box((4.4, 0.016, 0.11), (0, 4.192, 0.055))]
    hinge, width = (1.25, 2.06, 0.01), 0.88
    parts['paint'] = joined(frame_of_door(0.35, 1.25, 2.07, 2.0, -1), *skirting, placed(door_leaf(width, 2.04), hinge, turn(50)))
    parts['handle'] = placed(door_handle(width), hinge, turn(50))
    return parts


def furniture():
    parts = {'table': placed(round_table(), (-1.00, 0.90, 0)), 'chair': placed(chair(), (-1.30, 0.22, 0), turn(-158)),
             'rug': plate(2.3, 1.5, (-0.75, 0.55, 0.006)), 'bowl': placed(bowl(), (-1.06, 0.98, 0.74)),
             'carafe': placed(carafe(), (-0.93, 0.55, 0.7405)),
             'vase': placed(vase(0.62), (-0.40, 1.88, 1.4725))}
    parts['oranges'] = joined(*[ball(0.038, centre) for centre in (
        (-1.095, 0.99, 0.792), (-1.015, 1.00, 0.793), (-1.055, 0.925, 0.794), (-1.053, 0.975, 0.845))])
    parts['pot'] = placed(pot(0.17, 0.30), (-1.80, 1.62, 0))
    parts['plant'] = placed(plant(22, 4, 0.62), (-1.80, 1.62, 0.26))
    parts['soil'] = placed(lathe([[(0.145, 0), (0, 0.01)]], 32), (-1.80, 1.62, 0.268))
    brackets = [box((0.02, 0.16, 0.12), (x, 1.91, 1.39), 0.004) for x in (-1.15, -0.35)]
    frame = [box((0.03, w, h), (-2.185, 0.62 + y, 1.58 + z), 0.006) for w, h, y, z in (
        (0.68, 0.04, 0, 0.245), (0.68, 0.04, 0, -0.245), (0.04, 0.53, -0.32, 0), (0.04, 0.53, 0.32, 0))]
    parts['shelf'] = joined(box((1.0, 0.22, 0.025), (-0.75, 1.88, 1.46), 0.004), *brackets, *frame)
    parts['painting'] = wall(0.62, 0.47, (-2.19, 0.62, 1.58), 90)
    for k, row in enumerate(books(8, 0.66, 3)):
        parts[f'books-{k + 1}'] = placed(row, (-1.20, 1.79, 1.4725))
    return parts


def room():
    return {**shell(), **furniture()}, {
        'planks.png': textures.planks(), 'rug.png': textures.rug(), 'painting.png': textures.painting(),
        'wood.png': textures.wood(256, 128, (0.25, 0.13, 0.07), (0.42, 0.24, 0.13), 2), 'glaze.png': textures.glaze()}
