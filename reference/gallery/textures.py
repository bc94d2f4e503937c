"""Images for the scenes of the gallery, from formulas. Each is an array of bytes (height, width[, 3]) that repeats at its
edges, unless said otherwise, and has few different values, so that its file is small. Needs numpy.
"""
import numpy as np

TAU = 2 * np.pi


def to_bytes(values, step=4):
    """Numbers in [0, 1] as bytes that are multiples of `step`."""
    return np.clip(step * np.round(255 * np.asarray(values) / step), 0, 255).astype(np.uint8)


def texels(width, height):
    return np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)


def noise(width, height, cells, seed, octaves=3):
    """Sums of periodic smooth noise with cells (u, v) in the first octave, about 0 with a spread of about 1."""
    random = np.random.default_rng(seed)
    u, v = texels(width, height)
    total, weight = np.zeros((height, width)), 1.0
    for octave in range(octaves):
        nu, nv = cells[0] * 2 ** octave, cells[1] * 2 ** octave
        lattice = random.uniform(-1.7, 1.7, (nv, nu))
        x, y = u * nu - 0.5, v * nv - 0.5
        i, j = np.floor(x).astype(int), np.floor(y).astype(int)
        s, t = x - i, y - j
        s, t = s * s * (3 - 2 * s), t * t * (3 - 2 * t)
        at = lambda a, b: lattice[b % nv, a % nu]
        total += weight * ((at(i, j) * (1 - s) + at(i + 1, j) * s) * (1 - t) +
                           (at(i, j + 1) * (1 - s) + at(i + 1, j + 1) * s) * t)
        weight /= 2
    return total


def grain(width, height, seed):
    """Lines of wood along u, from 0 to 1."""
    warp = noise(width, height, (2, 3), seed, 2)
    _, v = texels(width, height)
    rings = 0.5 + 0.5 * np.sin(TAU * (9 * v + 0.55 * warp))
    return 0.65 * rings ** 2 + 0.35 * (0.5 + 0.5 * np.clip(noise(width, height, (4, 96), seed + 1, 1) / 1.7, -1, 1))


def wood(width, height, dark, light, seed):
    g = grain(width, height, seed)[..., None]
    return to_bytes(np.asarray(dark) * g + np.asarray(light) * (1 - g))


def planks(width=512, height=512, rows=6, seed=3):
    """Boards along u, each with a colour and a joint of its own."""
    random = np.random.default_rng(seed)
    u, v = texels(width, height)
    row = np.floor(v * rows).astype(int)
    joint = random.uniform(0, 1, (rows, 2)).cumsum(axis=1) * [1, 0.5]
    second = ((u - joint[row, 0]) % 1) > 0.55
    tone = random.uniform(0.85, 1.08, (rows, 2))[row, second.astype(int)]
    warm = random.uniform(-0.02, 0.02, (rows, 2))[row, second.astype(int)]
    shift = (random.integers(0, width, (rows, 2))[row, second.astype(int)] + (u * width).astype(int)) % width
    g = grain(width, height, seed + 5)[(v * height).astype(int), shift]
    colour = np.stack([0.60 + warm, 0.41 + 0 * warm, 0.25 - warm], axis=-1) * (tone * (1 - 0.38 * g))[..., None]
    gap = np.minimum(np.abs(v * rows - np.round(v * rows)) * height / rows,
                     np.minimum(((u - joint[row, 0]) % 1), ((u - joint[row, 0] - 0.55) % 1)) * width)
    return to_bytes(colour * np.clip(0.25 + 0.5 * gap, 0, 1)[..., None])


def mosaic(count=16, texel=16, seed=5):
    """Square tiles of glass in blues and greens, with light joints."""
    random = np.random.default_rng(seed)
    size = count * texel
    u, v = texels(size, size)
    i, j = (u * count).astype(int), (v * count).astype(int)
    mix, tone = random.uniform(0, 1, (count, count)) ** 1.3, random.uniform(0.65, 1.15, (count, count))
    deep, green = np.array([0.22, 0.52, 0.68]), np.array([0.42, 0.74, 0.72])
    colour = (deep + (green - deep) * mix[..., None]) * tone[..., None]
    edge = np.minimum(np.minimum(u * count % 1, 1 - u * count % 1), np.minimum(v * count % 1, 1 - v * count % 1)) * texel
    joint = np.clip(edge - 0.6, 0, 1)[..., None]
    return to_bytes(colour[j, i] * joint + np.array([0.72, 0.74, 0.70]) * (1 - joint))


def stone(size=256, seed=11):
    """Slabs of pale limestone, two to the side, with specks and veins."""
    u, v = texels(size, size)
    cloud = noise(size, size, (3, 3), seed, 4)
    vein = np.exp(-60 * np.abs(np.sin(np.pi * (u + 2 * v + 0.16 * cloud))))
    specks = noise(size, size, (48, 48), seed + 1, 1)
    tone = 0.80 + 0.035 * cloud - 0.10 * vein + 0.025 * specks
    joint = np.minimum(np.abs(2 * u - np.round(2 * u)), np.abs(2 * v - np.round(2 * v))) * size / 2
    return to_bytes(np.stack([tone, 0.955 * tone, 0.87 * tone], axis=-1) * np.clip(0.55 + 0.3 * joint, 0, 1)[..., None])


def cobbles(size=256, seed=7):
    """Setts in rows: colours and heights."""
    random = np.random.default_rng(seed)
    u, v = texels(size, size)
    rows, columns = 8, 6
    bend = 0.012 * noise(size, size, (6, 6), seed, 2)
    row = np.floor((v + bend) * rows).astype(int)
    x = (u + bend[::-1]) * columns + 0.5 * (row % 2)
    column = np.floor(x).astype(int) % columns
    s, t = 2 * (x % 1) - 1, 2 * ((v + bend) * rows % 1) - 1
    dome = np.clip(1 - np.maximum(np.abs(s) ** 5, np.abs(t) ** 4) ** 1.0, 0, 1) ** 0.5
    tone = random.uniform(0.28, 0.46, (rows, columns))[row % rows, column] * (0.85 + 0.06 * noise(size, size, (24, 24), seed, 2))
    colour = np.stack([tone * 1.03, tone, tone * 0.95], axis=-1) * (0.4 + 0.6 * dome ** 0.5)[..., None]
    return to_bytes(colour), to_bytes(0.85 * dome + 0.05 * noise(size, size, (24, 24), seed + 1, 2), 2)


def bricks(size=128, seed=9):
    random = np.random.default_rng(seed)
    u, v = texels(size, size)
    rows, columns = 8, 4
    row = np.floor(v * rows).astype(int)
    x = u * columns + 0.5 * (row % 2)
    tone = random.uniform(0.75, 1.15, (rows, columns))[row, np.floor(x).astype(int) % columns]
    joint = np.minimum(np.minimum(x % 1, 1 - x % 1) * size / columns, np.minimum(v * rows % 1, 1 - v * rows % 1) * size / rows)
    colour = np.array([0.42, 0.22, 0.16]) * (tone * (1 + 0.05 * noise(size, size, (32, 32), seed, 1)))[..., None]
    return to_bytes(np.where((joint > 1)[..., None], colour, np.array([0.40, 0.37, 0.33])))


def weave(size=64):
    """Height of a plain weave, eight threads to the side."""
    u, v = texels(size, size)
    a, b = np.sin(8 * np.pi * u), np.sin(8 * np.pi * v)
    over = np.sin(8 * np.pi * u) * np.sin(8 * np.pi * v) > 0
    return to_bytes(np.where(over, 0.55 + 0.45 * np.abs(a), 0.55 + 0.45 * np.abs(b)) * np.sqrt(np.abs(a * b)) ** 0.3, 2)


def rug(width=192, height=128):
    """A woven rug with borders and diamonds; does not repeat."""
    u, v = texels(width, height)
    x, y = np.abs(2 * u - 1), np.abs(2 * v - 1)
    red, blue, sand, dark = np.array([[0.34, 0.10, 0.08], [0.10, 0.13, 0.20], [0.52, 0.45, 0.34], [0.14, 0.07, 0.06]])
    diamonds = np.abs(((6 * u) % 1) - 0.5) + np.abs(((4 * v) % 1) - 0.5)
    colour = np.where((diamonds < 0.18)[..., None], sand, np.where((diamonds < 0.34)[..., None], blue, red))
    border = np.minimum((1 - x) * 1.5, 1 - y)
    teeth = ((24 * u).astype(int) + (16 * v).astype(int)) % 2 == 0
    colour = np.where((border < 0.30)[..., None], np.where(teeth[..., None], blue, dark), colour)
    colour = np.where(((border < 0.33) & (border > 0.27) | (border < 0.05))[..., None], sand, colour)
    thread = 0.9 + 0.1 * ((np.arange(width)[None] + np.arange(height)[:, None]) % 2)
    return to_bytes(colour * thread[..., None])


def painting(width=192, height=128):
    """Hills at dusk with a low sun; does not repeat."""
    u, v = texels(width, height)
    v = 1 - v                # the first row is at the bottom of a surface
    sky = np.stack([0.95 - 0.55 * (1 - v), 0.62 - 0.25 * (1 - v), 0.36 + 0.22 * (1 - v)], axis=-1)
    sun = np.exp(-((u - 0.68) ** 2 * 2.2 + (v - 0.52) ** 2) * 260)[..., None]
    colour = sky * (1 - sun) + np.array([1.0, 0.9, 0.6]) * sun
    for k, (line, tint) in enumerate([(0.56, (0.46, 0.33, 0.40)), (0.66, (0.28, 0.26, 0.34)), (0.8, (0.13, 0.17, 0.20))]):
        ridge = line + 0.05 * np.sin(TAU * (u * (1.3 + 0.6 * k) + 0.3 * k)) + 0.02 * np.sin(TAU * (u * 3.7 + 0.2 * k))
        colour = np.where((v > ridge)[..., None], np.asarray(tint), colour)
    return to_bytes(colour * (1 + 0.04 * noise(width, height, (48, 32), 4, 1))[..., None])


def glaze(width=256, height=128):
    """Blue brushwork on white: bands, waves and leaves round a vase. Repeats along u only."""
    u, v = texels(width, height)
    ink = np.zeros_like(u)
    for line in (0.10, 0.14, 0.52, 0.86, 0.90):
        ink = np.maximum(ink, np.abs(v - line) < 0.008)
    ink = np.maximum(ink, np.abs(v - 0.19 - 0.025 * np.sin(12 * TAU * u)) < 0.011)
    ink = np.maximum(ink, np.abs(v - 0.79 - 0.03 * np.sin(10 * TAU * u)) < 0.012)
    stem = 0.36 + 0.045 * np.sin(4 * TAU * u)
    ink = np.maximum(ink, np.abs(v - stem) < 0.008)
    for k in range(16):
        a, side = (k + 0.5) / 16, 1 if k % 2 else -1
        du = ((u - a + 0.5) % 1 - 0.5) * 2
        dv = v - (0.36 + 0.045 * np.sin(4 * TAU * a)) - 0.055 * side
        ink = np.maximum(ink, 0.75 * ((du * 0.8 + dv * side * 0.6) ** 2 / 0.0035 + (dv * 0.8 - du * side * 0.6) ** 2 / 0.0006 < 1))
    for k in range(8):
        du, dv = ((u - k / 8 + 0.5) % 1 - 0.5) * 2, v - 0.655
        r, phi = np.hypot(du, dv), np.arctan2(dv, du)
        ink = np.maximum(ink, 0.9 * (r < 0.045 * (1 + 0.45 * np.cos(6 * phi))) * (r > 0.012))
    blue, white = np.array([0.06, 0.13, 0.42]), np.array([0.90, 0.90, 0.86])
    return to_bytes(white + (blue - white) * ink[..., None])


def rust(size=128, seed=21):
    """A number from 0 to 1 in patches, for blends and roughnesses."""
    return to_bytes(np.clip(0.5 + 0.55 * noise(size, size, (4, 4), seed, 5), 0, 1), 8)
