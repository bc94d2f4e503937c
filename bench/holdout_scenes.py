#!/usr/bin/env python3
"""Scenes on which nothing of `auto` is fitted, made from a seed: bench/auto.py --set holdout judges it on them.

    holdout_scenes.py [--seed 2014] FOLDER

Five rooms with a partition and a door in it, lamps and furniture of random kinds, places and materials, the last with a
box of fog; four diffuse bodies in a block or a ball of rough glass, under a directional light, a point light and a
small area light; two rooms with a cloud of smoke that is denser in some places; and two bodies of a substance that
scatters light below a smooth or rough surface. Whoever works on the rules of `auto` uses other seeds. Writes
FOLDER/NAME.xml, what these files refer to, and prints what is in each scene.
"""
import argparse
import math
import random
import struct
from pathlib import Path
from typing import NamedTuple

SEED = 2014
ROOMS, BODIES, SMOKES, SUBSTANCES = 5, 4, 2, 2
ROOM_SIZE, BODY_SIZE = (128, 128), (160, 120)
SMOKE_NODES = 24


class Made(NamedTuple):
    name: str
    xml: str
    text: str  # what is in it
    size: tuple
    files: dict = {}  # name -> bytes

    def write(self, folder):
        """Returns the scene file."""
        for name, content in self.files.items():
            (folder / name).write_bytes(content)
        file = folder / f'{self.name}.xml'
        file.write_text(self.xml)
        return file


def rgb(r, low=0.2, high=0.8):
    return ', '.join(f'{r.uniform(low, high):.2f}' for _ in range(3))


def transform(scale, at, turn=0.0, tilt=(0, 0, 1), degrees=0.0):
    """Scale, then a rotation about `tilt`, then one about z, then a translation."""
    text = '<transform name="to_world">'
    text += '<scale x="{:.3f}" y="{:.3f}" z="{:.3f}"/>'.format(*scale)
    if degrees:
        text += '<rotate x="{}" y="{}" z="{}" angle="{:.1f}"/>'.format(*tilt, degrees)
    if turn:
        text += f'<rotate z="1" angle="{turn:.1f}"/>'
    return text + '<translate x="{:.3f}" y="{:.3f}" z="{:.3f}"/></transform>'.format(*at)


def cube(scale, at, bsdf, turn=0.0, more=''):
    return f'<shape type="cube">{transform(scale, at, turn)}{bsdf}{more}</shape>'


def sphere(radius, at, bsdf, more=''):
    centre = 'x="{:.3f}" y="{:.3f}" z="{:.3f}"'.format(*at)
    return (f'<shape type="sphere"><point name="center" {centre}/><float name="radius" value="{radius:.3f}"/>'
            f'{bsdf}{more}</shape>')


def area(radiance):
    return f'<emitter type="area"><rgb name="radiance" value="{radiance:.2f}"/></emitter>'


def diffuse(r, low=0.2, high=0.8):
    return f'<bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="{rgb(r, low, high)}"/></bsdf></bsdf>'


def rough(kind, alpha, inside=''):
    return f'<bsdf type="{kind}"><string name="distribution" value="ggx"/><float name="alpha" value="{alpha:.3f}"/>{inside}</bsdf>'


def alpha(r, low, high):
    return math.exp(r.uniform(math.log(low), math.log(high)))


GLASS = '<bsdf type="dielectric"><float name="int_ior" value="1.5"/></bsdf>'
SILVER = '<bsdf type="conductor"><string name="material" value="Ag"/></bsdf>'


def material(r, specular):
    """A BSDF and its name."""
    kinds = ['diffuse'] * 4 + ['roughplastic', 'roughconductor', 'roughdielectric']
    kind = r.choice(kinds + ['plastic', 'conductor', 'dielectric'] if specular else kinds)
    if kind == 'diffuse':
        return diffuse(r), kind
    if kind in ('dielectric', 'conductor'):
        return GLASS if kind == 'dielectric' else SILVER, kind
    if kind == 'plastic':
        return f'<bsdf type="plastic"><rgb name="diffuse_reflectance" value="{rgb(r)}"/></bsdf>', kind
    a = alpha(r, 0.06, 0.4)
    inside = ''
    if kind == 'roughplastic':
        inside = f'<rgb name="diffuse_reflectance" value="{rgb(r)}"/>'
    elif kind == 'roughconductor':
        inside = '<string name="material" value="Cu"/>'
    return rough(kind, a, inside), f'{kind} {a:.2f}'


def sensor(origin, target, fov, size):
    return (f'<sensor type="perspective"><float name="fov" value="{fov:.0f}"/><transform name="to_world">'
            '<lookat origin="{:.2f}, {:.2f}, {:.2f}" target="{:.2f}, {:.2f}, {:.2f}" up="0, 0, 1"/></transform>'
            .format(*origin, *target) +
            '<sampler type="independent"><integer name="sample_count" value="64"/></sampler>'
            f'<film type="hdrfilm"><integer name="width" value="{size[0]}"/><integer name="height" value="{size[1]}"/>'
            '<rfilter type="box"/></film></sensor>')


def scene(depth, parts):
    body = '\n  '.join(parts)
    # Mitsuba's path knows nothing of media.
    integrator = 'volpath' if '<medium' in body else 'path'
    return (f'<scene version="3.0.0">\n  <integrator type="{integrator}"><integer name="max_depth" value="{depth}"/></integrator>\n'
            f'  {body}\n</scene>\n')


def walls(r, w, d, h):
    """A room from −w to w, −d to d, 0 to h."""
    thick = 0.05
    floor = r.choice([diffuse(r), diffuse(r), rough('roughplastic', alpha(r, 0.1, 0.3),
                                                    f'<rgb name="diffuse_reflectance" value="{rgb(r)}"/>')])
    boxes = [((w, d, thick), (0, 0, -thick), floor), ((w, d, thick), (0, 0, h + thick), diffuse(r, 0.6, 0.8)),
             ((thick, d, h / 2), (-w - thick, 0, h / 2), diffuse(r)), ((thick, d, h / 2), (w + thick, 0, h / 2), diffuse(r)),
             ((w, thick, h / 2), (0, -d - thick, h / 2), diffuse(r)), ((w, thick, h / 2), (0, d + thick, h / 2), diffuse(r))]
    return [cube(*b) for b in boxes]


def partition(r, w, h, y):
    """A wall across the room with a door that stands open by a random angle."""
    x, width, height, leaf = r.uniform(-0.5, 0.5) * w, r.uniform(0.7, 1.0), 2.0, r.uniform(15, 80)
    left, right = x - width / 2, x + width / 2
    wall = diffuse(r, 0.5, 0.8)
    angle = math.radians(leaf)
    middle = (left + width / 2 * math.cos(angle), y + width / 2 * math.sin(angle), height / 2)
    return [cube(((left + w) / 2, 0.05, h / 2), ((left - w) / 2, y, h / 2), wall),
            cube(((w - right) / 2, 0.05, h / 2), ((w + right) / 2, y, h / 2), wall),
            cube((width / 2, 0.05, (h - height) / 2), (x, y, (h + height) / 2), wall),
            cube((width / 2 - 0.01, 0.02, height / 2), middle, diffuse(r), leaf)], f'door {leaf:.0f}°'


def lamp(r, at, h, strength):
    x, y = at
    kind = r.choice(['panel', 'bulb', 'bulb in glass', 'point', 'spot'])
    z = h - r.uniform(0.3, 0.6)
    power = strength * r.uniform(15, 40)
    if kind == 'panel':
        s = r.uniform(0.15, 0.4)
        at = transform((s, s, 1), (x, y, h - 0.02), 0, (1, 0, 0), 180)
        return f'<shape type="rectangle">{at}<bsdf type="diffuse"/>{area(power / (4 * s * s) / 3)}</shape>', kind
    if kind.startswith('bulb'):
        s = r.uniform(0.05, 0.1)
        bulb = sphere(s, (x, y, z), '<bsdf type="diffuse"/>', area(power / (12 * s * s) / 3))
        return bulb + (sphere(2 * s, (x, y, z), GLASS) if kind == 'bulb in glass' else ''), kind
    place = f'x="{x:.2f}" y="{y:.2f}" z="{z:.2f}"'
    if kind == 'point':
        return f'<emitter type="point"><point name="position" {place}/><rgb name="intensity" value="{power / 6:.2f}"/></emitter>', kind
    return ('<emitter type="spot"><float name="cutoff_angle" value="40"/><transform name="to_world">'
            f'<lookat origin="{x:.2f}, {y:.2f}, {z:.2f}" target="{x + r.uniform(-1, 1):.2f}, {y + r.uniform(-1, 1):.2f}, 0" up="0, 1, 0"/>'
            f'</transform><rgb name="intensity" value="{power / 2:.2f}"/></emitter>'), kind


def furniture(r, places, specular):
    parts, names = [], []
    for x, y in places:
        bsdf, name = material(r, specular)
        if name.startswith(('dielectric', 'roughdielectric')) or r.random() < 0.5:
            s = r.uniform(0.2, 0.4)
            parts.append(sphere(s, (x, y, s + 0.01), bsdf))
            names.append(f'ball: {name}')
        else:
            s = [r.uniform(0.15, 0.4) for _ in range(3)]
            parts.append(cube(s, (x, y, s[2]), bsdf, r.uniform(0, 90)))
            names.append(f'block: {name}')
    return parts, names


def smoke_density(r):
    """A grid of SMOKE_NODES³ densities from 0 to 1 in Mitsuba's format: the sum of some round puffs."""
    puffs = [([r.uniform(0.25, 0.75) for _ in range(3)], r.uniform(0.08, 0.2)) for _ in range(r.randint(4, 8))]
    at = [(i + 0.5) / SMOKE_NODES for i in range(SMOKE_NODES)]
    values = [min(1.0, sum(math.exp(-((x - c[0]) ** 2 + (y - c[1]) ** 2 + (z - c[2]) ** 2) / (2 * s * s)) for c, s in puffs))
              for z in at for y in at for x in at]
    return b'VOL\x03' + struct.pack('<5i6f', 1, *(SMOKE_NODES,) * 3, 1, 0, 0, 0, 1, 1, 1) + struct.pack(f'<{len(values)}f', *values)


def fog_in(r, w, d, h):
    return ('<medium type="homogeneous" name="interior">'
            f'<float name="sigma_t" value="{r.uniform(0.2, 0.5):.2f}"/><rgb name="albedo" value="0.9"/></medium>')


def smoke_in(r, w, d, h, file):
    """A cloud in the box that room() puts a medium into."""
    to_world = transform((1.2 * w, 0.4 * d, 0.7 * h), (-0.6 * w, -0.7 * d, 0.05 * h))
    return (f'<medium type="heterogeneous" name="interior"><volume type="gridvolume" name="sigma_t">'
            f'<string name="filename" value="{file}"/>{to_world}</volume><float name="scale" value="{r.uniform(1, 3):.2f}"/>'
            f'<rgb name="albedo" value="{rgb(r, 0.7, 0.95)}"/></medium>')


def room(r, medium=None, name=''):
    """A room; medium(r, w, d, h) is what fills a box before the partition."""
    w, d, h = r.uniform(1.8, 2.6), r.uniform(2.2, 3.2), r.uniform(2.4, 3.0)
    y = r.uniform(0.1, 0.4) * d
    wall, door = partition(r, w, h, y)
    spots = [(i * w / 2.2, j * d / 4 - d / 2.4) for i in (-1, 0, 1) for j in (0, 1, 2) if j * d / 4 - d / 2.4 < y - 0.5]
    r.shuffle(spots)
    things, names = furniture(r, spots[:r.randint(2, 4)], not medium)
    # A lamp behind the partition, the stronger if there is none before it.
    front = r.random() < 0.6
    lamps = [lamp(r, (r.uniform(-0.6, 0.6) * w, r.uniform(y + 0.4, d - 0.4)), h, 1 if front else 8)]
    if front:
        lamps.append(lamp(r, (r.uniform(-0.6, 0.6) * w, r.uniform(-0.3 * d, y - 0.4)), h, 1))
    parts = [sensor((r.uniform(-0.4, 0.4) * w, -d + 0.15, r.uniform(1.2, 1.7)), (0, y, r.uniform(0.6, 1.0)), r.uniform(60, 75), ROOM_SIZE),
             *walls(r, w, d, h), *wall, *things, *(text for text, _ in lamps)]
    if medium:
        parts.append(cube((0.6 * w, 0.2 * d, 0.35 * h), (0, -0.5 * d, 0.4 * h), '<bsdf type="null"/>', 0, medium(r, w, d, h)))
        names.append(name)
    return scene(10, parts), '; '.join([door, *(f'lamp: {kind}' for _, kind in lamps), *names])


def body(r, light):
    a = alpha(r, 0.05, 0.3)
    glass = rough('roughdielectric', a, '<float name="int_ior" value="1.5"/>')
    shell, inner = r.choice(['block', 'ball']), r.choice(['block', 'ball'])
    size, turn = r.uniform(0.9, 1.1), r.uniform(0, 90)
    at = (0, 0, size + 0.02)
    s = size * r.uniform(0.3, 0.45)
    x, y = r.uniform(-0.7, 0.7), r.uniform(-0.5, 0.5)
    parts = [sensor((r.uniform(-1, 1), -r.uniform(5, 6), r.uniform(2, 3.5)), (0, 0, 0.8), 38, BODY_SIZE),
             f'<shape type="rectangle">{transform((6, 6, 1), (0, 0, 0))}{diffuse(r, 0.3, 0.7)}</shape>',
             cube((size,) * 3, at, glass, turn) if shell == 'block' else sphere(size, at, glass),
             cube((s,) * 3, at, diffuse(r), r.uniform(0, 90)) if inner == 'block' else sphere(s, at, diffuse(r))]
    parts.append(light_above(light, x, y))
    return scene(12, parts), f'{inner} in a {shell} of glass, α = {a:.2f}, under a {light} light'


def light_above(kind, x, y):
    if kind == 'directional':
        return (f'<emitter type="directional"><vector name="direction" x="{x:.2f}" y="{y:.2f}" z="-1"/>'
                '<rgb name="irradiance" value="3"/></emitter>')
    if kind == 'point':
        return (f'<emitter type="point"><point name="position" x="{3 * x:.2f}" y="{3 * y:.2f}" z="4"/>'
                '<rgb name="intensity" value="40"/></emitter>')
    return sphere(0.1, (3 * x, 3 * y, 4), '<bsdf type="diffuse"/>', area(1200))


def substance(r, light):
    """A body that light enters and is scattered in, on a table."""
    a = alpha(r, 0.05, 0.3) if r.random() < 0.5 else 0
    surface = rough('roughdielectric', a, '<float name="int_ior" value="1.4"/>') if a else GLASS
    density, shape, size, turn = r.uniform(2, 8), r.choice(['block', 'ball']), r.uniform(0.8, 1.1), r.uniform(0, 90)
    medium = (f'<medium type="homogeneous" name="interior"><float name="sigma_t" value="{density:.2f}"/>'
              f'<rgb name="albedo" value="{rgb(r, 0.8, 0.98)}"/>'
              f'<phase type="hg"><float name="g" value="{r.uniform(-0.2, 0.7):.2f}"/></phase></medium>')
    at = (0, 0, size + 0.02)
    parts = [sensor((r.uniform(-1, 1), -r.uniform(5, 6), r.uniform(2, 3.5)), (0, 0, 0.8), 38, BODY_SIZE),
             f'<shape type="rectangle">{transform((6, 6, 1), (0, 0, 0))}{diffuse(r, 0.3, 0.7)}</shape>',
             cube((size,) * 3, at, surface, turn, medium) if shape == 'block' else sphere(size, at, surface, medium),
             light_above(light, r.uniform(-0.7, 0.7), r.uniform(-0.5, 0.5))]
    return scene(24, parts), f'{shape}, σt = {density:.1f}, α = {a:.2f}, under a {light} light'


def make(seed=SEED):
    """Every scene."""
    made = []
    for i in range(ROOMS):
        fog = i == ROOMS - 1
        xml, text = room(random.Random(f'{seed}-room-{i}'), fog_in if fog else None, 'fog')
        made.append(Made(f'room-{i + 1}', xml, text, ROOM_SIZE))
    lights = ('directional', 'point', 'small area')
    for i in range(BODIES):
        xml, text = body(random.Random(f'{seed}-body-{i}'), lights[i % 3])
        made.append(Made(f'body-{i + 1}', xml, text, BODY_SIZE))
    for i in range(SMOKES):
        r, file = random.Random(f'{seed}-smoke-{i}'), f'smoke-{i + 1}.vol'
        density = smoke_density(r)
        xml, text = room(r, lambda *box: smoke_in(*box, file), 'smoke')
        made.append(Made(f'smoke-{i + 1}', xml, text, ROOM_SIZE, {file: density}))
    for i in range(SUBSTANCES):
        xml, text = substance(random.Random(f'{seed}-substance-{i}'), lights[2 - i])
        made.append(Made(f'substance-{i + 1}', xml, text, BODY_SIZE))
    return made


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument('folder', type=Path)
    p.add_argument('--seed', type=int, default=SEED)
    o = p.parse_args()
    o.folder.mkdir(parents=True, exist_ok=True)
    for made in make(o.seed):
        made.write(o.folder)
        print(f'{made.name:12}{made.text}')


if __name__ == '__main__':
    main()
