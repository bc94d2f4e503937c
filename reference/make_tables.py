#!/usr/bin/env python3
"""Ask Mitsuba how its small parts behave and write the answers to reference/tables/*.json.

    make_tables.py [NAME...]        filters cameras surfaces uv_partials textures lights (default: all)

The tests compare Duet's filters, cameras, shapes, textures and lights with these tables number by
number. Mitsuba (pip install mitsuba==3.9.1) is needed only to make them anew. The inputs are drawn
from fixed seeds; each table starts with the version that answered.
"""
import json
import sys
from pathlib import Path

import mitsuba as mi
import numpy as np

mi.set_variant('scalar_rgb')
OUT = Path(__file__).parent / 'tables'


def plain(x):
    """Nested numbers with nine significant digits, which is all that single precision has."""
    if isinstance(x, dict):
        return {k: plain(v) for k, v in x.items()}
    if isinstance(x, (list, tuple)):
        return [plain(v) for v in x]
    if isinstance(x, (bool, str, int)) or x is None:
        return x
    if isinstance(x, (float, np.floating)):
        return float(f'{float(x):.9g}')
    return plain(np.array(x).tolist())


def write(name, note, **content):
    """One line per entry of each list, so that a change can be read."""
    out = {'mitsuba': mi.__version__, 'note': note, **plain(content)}
    parts = []
    for key, value in out.items():
        if isinstance(value, list):
            rows = ',\n  '.join(json.dumps(v, separators=(',', ':')) for v in value)
            parts.append(f'{json.dumps(key)}: [\n  {rows}\n]')
        else:
            parts.append(f'{json.dumps(key)}: {json.dumps(value)}')
    path = OUT / f'{name}.json'
    path.write_text('{\n' + ',\n'.join(parts) + '\n}\n')
    print(path, path.stat().st_size, 'bytes')


# ---- Filters -------------------------------------------------------------------------------------

def filters():
    kinds = [('box', {}), ('tent', {}), ('tent', {'radius': 1.7}), ('gaussian', {}),
             ('gaussian', {'stddev': 0.8}), ('mitchell', {}), ('mitchell', {'B': 0.2, 'C': 0.5}),
             ('catmullrom', {}), ('lanczos', {}), ('lanczos', {'lobes': 2})]
    rows = []
    for kind, parameters in kinds:
        f = mi.load_dict({'type': kind, **parameters})
        # Not at the very edge, where rounding decides.
        xs = np.linspace(0, 1, 30, endpoint=False) * f.radius() + 0.003
        rows.append({'kind': kind, 'parameters': parameters, 'radius': f.radius(),
                     'border': f.border_size(), 'values': [[x, f.eval(float(x))] for x in xs]})
    write('filters', 'values: [distance, weight]', filters=rows)


# ---- Cameras -------------------------------------------------------------------------------------

def cameras():
    look = mi.ScalarTransform4f().look_at([1, 2, 3], [0, .5, 0], [0, 1, 0])
    mirror = look @ mi.ScalarTransform4f().scale([-1, 1, 1])
    stretched = look @ mi.ScalarTransform4f().scale([2, 3, 4])
    rows = []

    def add(kind, size, to_world, **parameters):
        film = {'type': 'hdrfilm', 'width': size[0], 'height': size[1]}
        camera = mi.load_dict({'type': kind, 'film': film, 'to_world': to_world, **parameters})
        rays = []
        for x, y in [(0, 0), (1, 1), (.5, .5), (.25, .75), (.9, .1), (.31, .02)]:
            for a in [(.3, .8), (.95, .4), (.5, .1)] if kind == 'thinlens' else [(.5, .5)]:
                r, _ = camera.sample_ray(0, .5, mi.Point2f(x, y), mi.Point2f(*a))
                rays.append([x * size[0], y * size[1], *a, *r.o, *r.d, r.maxt])
        rows.append({'kind': kind, 'size': size, 'to_world': np.array(to_world.matrix),
                     'parameters': parameters, 'rays': rays})

    for size in [(48, 32), (30, 50), (40, 40)]:
        for axis in ['x', 'y', 'diagonal', 'smaller', 'larger']:
            add('perspective', size, look, fov=50., fov_axis=axis, near_clip=.1, far_clip=100.)
    add('perspective', (48, 32), look, fov=65., principal_point_offset_x=.1,
        principal_point_offset_y=-.2, near_clip=.5, far_clip=50.)
    add('perspective', (48, 32), mirror, fov=65., near_clip=.5, far_clip=50.)
    add('thinlens', (48, 32), look, fov=50., aperture_radius=.2, focus_distance=2.5,
        near_clip=.5, far_clip=50.)
    add('thinlens', (30, 50), mirror, fov=40., fov_axis='larger', aperture_radius=.7,
        focus_distance=6., near_clip=.5, far_clip=50.)
    for size in [(48, 32), (30, 50)]:
        for to_world in [look, mirror, stretched]:
            add('orthographic', size, to_world, near_clip=.5, far_clip=50.)
    write('cameras', 'rays: [film x, y, lens u, v, origin, direction, length]; film in pixels',
          cameras=rows)


# ---- Shapes --------------------------------------------------------------------------------------

# A roof of four triangles with a vertex that two of them see at other texture coordinates.
MESH = {
    'positions': [[-1, -1, 0], [1, -1, .2], [1.1, 1, 0], [-1, .9, .1], [.1, 0, .8], [.2, 2, .3]],
    'normals': [[-.4, -.4, .8], [.5, -.3, .7], [.3, .3, .9], [-.5, .3, .8], [0, .1, 1], [0, .7, .7]],
    'uvs': [[0, 0], [1, .1], [.9, 1], [.1, .8], [.5, .55], [.4, 1.7]],
    'triangles': [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [3, 2, 5]],
}


def make_mesh(with_normals, with_uvs, flip=False):
    props = mi.Properties()
    props['flip_normals'] = flip
    n, f = len(MESH['positions']), len(MESH['triangles'])
    mesh = mi.Mesh('roof', n, f, props=props, has_vertex_normals=with_normals,
                   has_vertex_texcoords=with_uvs)
    p = mi.traverse(mesh)
    p['vertex_positions'] = np.ravel(MESH['positions']).astype(np.float32)
    p['faces'] = np.ravel(MESH['triangles']).astype(np.uint32)
    if with_uvs:
        p['vertex_texcoords'] = np.ravel(MESH['uvs']).astype(np.float32)
    p.update()
    if with_normals:
        normals = np.array(MESH['normals'], dtype=np.float64)
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        p['vertex_normals'] = np.ravel(normals).astype(np.float32)
        p.update()
    return mesh


def surfaces():
    t = mi.ScalarTransform4f
    rigid = t().translate([.3, -.2, .5]) @ t().rotate(np.array([1, 2, 3]) / 14 ** .5, 40) @ t().scale(1.7)
    sheared = t(np.array([[1.2, .3, .1, .2], [-.2, .9, .4, -.5], [.1, -.3, 1.5, .7], [0, 0, 0, 1]]))
    mirror = t().translate([-.1, .4, .2]) @ t().rotate([0, .6, .8], 70) @ t().scale([-1.3, 1.3, 1.3])
    round_mirror = t().translate([-.1, .4, .2]) @ t().rotate([0, .6, .8], 70) @ t().scale(-1.3)
    rng = np.random.default_rng(7)
    rows = []

    def add(shape, to_world, flip, instance=None):
        params = {'type': shape}
        if shape.startswith('mesh'):
            path = f'/tmp/duet_table_{shape}.ply'
            make_mesh('n' in shape[4:], 'u' in shape[4:]).write_ply(path)
            params = {'type': 'ply', 'filename': path}
            if 'n' not in shape[4:]:
                params['face_normals'] = True
        params['to_world'] = to_world
        params['flip_normals'] = flip
        if instance is None:
            scene = mi.load_dict({'type': 'scene', 'shape': params})
        else:
            scene = mi.load_dict({'type': 'scene', 'group': {'type': 'shapegroup', 'shape': params},
                                  'instance': {'type': 'instance', 'to_world': instance,
                                               'group': {'type': 'ref', 'id': 'group'}}})
        box = scene.bbox()
        center, radius = np.array(box.center()), np.linalg.norm(np.array(box.extents())) / 2
        hits = []
        while len(hits) < 10:
            o = rng.normal(size=3)
            o = center + o / np.linalg.norm(o) * radius * 3
            d = center + rng.uniform(-.6, .6, size=3) * radius - o
            o, d = o.astype(np.float32), (d / np.linalg.norm(d)).astype(np.float32)
            si = scene.ray_intersect(mi.Ray3f(o, d))
            if not si.is_valid():
                continue
            si.initialize_sh_frame()
            if abs(np.dot(si.n, d)) < .05:
                continue
            hits.append([*o, *d, si.t, *si.p, *si.n, *si.sh_frame.n, *si.uv, *si.dp_du, *si.dp_dv,
                         *si.sh_frame.s])
        rows.append({'shape': shape, 'to_world': np.array(to_world.matrix), 'flip': flip,
                     'instance': None if instance is None else np.array(instance.matrix),
                     'hits': hits})

    # Mitsuba's spheres and cylinders cannot be stretched unevenly.
    for shape, transforms in [('rectangle', [t(), sheared, mirror]), ('cube', [t(), sheared, mirror]),
                              ('sphere', [t(), rigid, round_mirror]), ('disk', [t(), rigid, mirror]),
                              ('cylinder', [t(), rigid, round_mirror])]:
        for to_world in transforms:
            for flip in [False, True]:
                add(shape, to_world, flip)
    for shape in ['mesh', 'mesh-n', 'mesh-u', 'mesh-nu']:
        for to_world in [t(), mirror]:
            for flip in [False, True]:
                add(shape, to_world, flip)
    for shape in ['rectangle', 'sphere', 'mesh', 'mesh-nu']:
        for instance in [rigid, mirror]:
            add(shape, rigid, False, instance)
    write('surfaces', 'hits: [ray origin, direction, distance, position, normal, shading normal, uv, '
          'dp/du, dp/dv, tangent of the shading frame]', mesh=MESH, cases=rows)


def uv_partials():
    t = mi.ScalarTransform4f
    look = t().look_at([1, 2, 3], [0, .2, 0], [0, 1, 0])
    sheared = t(np.array([[1.2, .3, .1, .2], [-.2, .9, .4, -.5], [.1, -.3, 1.5, .7], [0, 0, 0, 1]]))
    # Mitsuba lets the neighbours of a pinhole's ray begin on the near plane, not in the pinhole: with
    # a plane so near, nobody sees it.
    near = {'near_clip': 1e-4, 'far_clip': 100.}
    sensors = [('perspective', look, {'fov': 50., **near}),
               ('perspective', look @ t().scale([-1, 1, 1]), {'fov': 20., **near}),
               ('thinlens', look, {'fov': 50., 'aperture_radius': .2, 'focus_distance': 2.5, **near}),
               ('orthographic', look, near), ('orthographic', look @ t().scale([2, 3, 4]), near)]
    rng = np.random.default_rng(17)
    size = (48, 32)
    rows = []
    for kind, to_world, parameters in sensors:
        camera = mi.load_dict({'type': kind, 'film': {'type': 'hdrfilm', 'width': size[0], 'height': size[1]},
                               'to_world': to_world, **parameters})
        for shape, place in [('rectangle', sheared), ('sphere', t().scale(.8)), ('cylinder', t())]:
            scene = mi.load_dict({'type': 'scene', 'shape': {'type': shape, 'to_world': place}})
            found = []
            while len(found) < 3:
                (x, y), lens = rng.uniform(.2, .8, 2).astype(np.float32), rng.uniform(0, 1, 2).astype(np.float32)
                ray, _ = camera.sample_ray_differential(0, .5, mi.Point2f(x, y), mi.Point2f(*lens))
                si = scene.ray_intersect(ray)
                if not si.is_valid() or abs(np.dot(si.n, ray.d)) < .1:
                    continue
                si.compute_uv_partials(ray)
                found.append([x * size[0], y * size[1], *lens, *si.duv_dx, *si.duv_dy])
            rows.append({'kind': kind, 'size': size, 'to_world': np.array(to_world.matrix),
                         'parameters': parameters, 'shape': shape, 'place': np.array(place.matrix),
                         'found': found})
    write('uv_partials', 'found: [film x, y, lens u, v, duv/dx, duv/dy]; film in pixels', cases=rows)


# ---- Textures ------------------------------------------------------------------------------------

def at_uv(u, v):
    si = mi.SurfaceInteraction3f()
    si.uv = mi.Point2f(u, v)
    return si


def textures():
    rng = np.random.default_rng(11)
    lookups = [*rng.uniform(0, 1, (10, 2)), *rng.uniform(-4, 4, (10, 2)), [0, 0], [.125, .5]]
    # float32, as the renderer will see them
    lookups = np.array(lookups, dtype=np.float32)
    rows = []

    def look_up(texture, with_gradient):
        out = []
        for u, v in lookups:
            si = at_uv(u, v)
            gradient = list(texture.eval_1_grad(si)) if with_gradient else [0, 0]
            out.append([u, v, *texture.eval(si), texture.eval_1(si), *gradient])
        return out

    colors = rng.uniform(0, 2, (3, 4, 3)).astype(np.float32)
    greys = rng.uniform(0, 2, (5, 2, 1)).astype(np.float32)
    bytes3 = rng.integers(0, 256, (3, 3, 3)).astype(np.uint8)
    bytes1 = rng.integers(0, 256, (4, 3, 1)).astype(np.uint8)
    thin = rng.uniform(0, 2, (1, 3, 3)).astype(np.float32)
    matrix = np.array([[2, .3, .1], [-.5, 3, .2], [0, 0, 1]])
    for pixels in [colors, greys, bytes3, bytes1, thin]:
        for filter_type in ['nearest', 'bilinear']:
            for wrap in ['repeat', 'mirror', 'clamp']:
                for raw in [True, False] if pixels.dtype == np.uint8 else [True]:
                    to_uv = matrix if wrap != 'mirror' else np.eye(3)
                    # Full precision, where Mitsuba would keep halves of 8-bit images.
                    t = mi.load_dict({'type': 'bitmap', 'bitmap': mi.Bitmap(pixels), 'raw': raw,
                                      'filter_type': filter_type, 'wrap_mode': wrap,
                                      'format': 'variant', 'to_uv': mi.ScalarTransform3f(to_uv)})
                    rows.append({'kind': 'bitmap', 'width': pixels.shape[1], 'height': pixels.shape[0],
                                 'channels': pixels.shape[2], 'bytes': pixels.dtype == np.uint8,
                                 'pixels': np.ravel(pixels).tolist(), 'filter': filter_type,
                                 'wrap': wrap, 'raw': raw, 'to_uv': to_uv[:2], 'mean': t.mean(),
                                 'lookups': look_up(t, True)})
    for to_uv in [np.eye(3), matrix]:
        t = mi.load_dict({'type': 'checkerboard', 'to_uv': mi.ScalarTransform3f(to_uv),
                          'color0': {'type': 'rgb', 'value': [.1, .4, .7]},
                          'color1': {'type': 'rgb', 'value': [.9, .2, .3]}})
        rows.append({'kind': 'checkerboard', 'to_uv': to_uv[:2], 'mean': t.mean(),
                     'lookups': look_up(t, False)})

    mesh = make_mesh(False, False)
    n, f = len(MESH['positions']), len(MESH['triangles'])
    data = {'vertex_color': rng.uniform(0, 1, (n, 3)), 'vertex_grey': rng.uniform(0, 1, (n, 1)),
            'face_color': rng.uniform(0, 1, (f, 3)), 'face_grey': rng.uniform(0, 1, (f, 1))}
    for name, values in data.items():
        mesh.add_attribute(name, values.shape[1], np.ravel(values).astype(np.float32))
    scene = mi.load_dict({'type': 'scene', 'mesh': mesh})
    attributes = []
    for name, values in data.items():
        t = mi.load_dict({'type': 'mesh_attribute', 'name': name, 'scale': 1.5})
        found = []
        while len(found) < 8:
            x, y = rng.uniform(-1, 1, 2).astype(np.float32)
            si = scene.ray_intersect(mi.Ray3f([x, y, 3], [0, 0, -1]))
            if si.is_valid():
                found.append([x, y, *t.eval(si), t.eval_1(si) if values.shape[1] == 1 else -1])
        attributes.append({'name': name, 'channels': values.shape[1], 'scale': 1.5,
                           'data': np.ravel(values), 'lookups': found})
    write('textures', 'lookups: [u, v, r, g, b, value, gradient], of mesh attributes [x, y, r, g, b, '
          'value or -1] for a ray down from (x, y, 3)', mesh=MESH, textures=rows,
          attributes=attributes)


# ---- Lights --------------------------------------------------------------------------------------

def lights():
    t = mi.ScalarTransform4f
    look = t().look_at([1, 2, 3], [0, .5, 0], [0, 1, 0])
    scaled = look @ t().scale(2)
    rng = np.random.default_rng(13)
    points = np.concatenate([rng.uniform(-1.5, 1.5, (12, 3)), rng.uniform(-4, 4, (12, 3))])
    points = points.astype(np.float32)
    image = rng.uniform(0, 1, (5, 6, 3)).astype(np.float32)
    bitmap = {'type': 'bitmap', 'bitmap': mi.Bitmap(image), 'raw': True}
    delta = []

    def add(kind, to_world, **parameters):
        shown = {k: v['value'] if isinstance(v, dict) and 'value' in v else v
                 for k, v in parameters.items() if not (isinstance(v, dict) and 'bitmap' in v)}
        light = mi.load_dict({'type': kind, 'to_world': to_world, **parameters})
        rows = []
        for p in points:
            it = mi.SurfaceInteraction3f()
            it.p = mi.Point3f(p)
            ds, weight = light.sample_direction(it, mi.Point2f(.5))
            rows.append([*p, *ds.d, ds.dist, *weight])
        delta.append({'kind': kind, 'to_world': np.array(to_world.matrix), 'parameters': shown,
                      'textured': len(shown) < len(parameters), 'samples': rows})

    rgb = {'type': 'rgb', 'value': [1., 2., 3.]}
    add('point', look, intensity=rgb)
    add('spot', look, intensity=rgb)
    add('spot', look, intensity=rgb, cutoff_angle=35., beam_width=10.)
    add('spot', scaled, intensity=rgb, cutoff_angle=35., beam_width=35.)
    add('spot', look, intensity=rgb, cutoff_angle=60., texture=bitmap)
    for axis in ['x', 'y', 'diagonal', 'smaller', 'larger']:
        add('projector', look, irradiance=bitmap, scale=3., fov=70., fov_axis=axis)
    add('projector', scaled, irradiance=bitmap, fov=70.)
    add('projector', look, irradiance=rgb, fov=90.)
    add('directional', look, irradiance=rgb)
    add('directional', scaled, irradiance=rgb)

    environments = []
    mirror = look @ t().scale([-1, 1, 1])
    sky = rng.uniform(0, 1, (6, 8, 3)).astype(np.float32) ** 3
    directions = rng.normal(size=(40, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    directions = [*directions, [0, 0, 1], [0, 0, -1], [1, 0, 0], [-1, 0, 0], [1e-4, 1, 0],
                  [0, -1, 1e-4], [1e-6, 0, -1], [-1e-6, 0, -1]]
    for to_world in [t(), look, mirror]:
        light = mi.load_dict({'type': 'envmap', 'bitmap': mi.Bitmap(sky), 'scale': 2.,
                              'to_world': to_world})
        rows = []
        for d in np.array(directions, dtype=np.float32):
            si = mi.SurfaceInteraction3f()
            si.wi = -mi.Vector3f(d)
            ds = mi.DirectionSample3f()
            ds.d = mi.Vector3f(d)
            rows.append([*d, *light.eval(si), light.pdf_direction(si, ds)])
        environments.append({'to_world': np.array(to_world.matrix), 'scale': 2., 'directions': rows})
    write('lights', 'samples: [lit point, direction, distance, weight]; directions: [direction, '
          'radiance, density]', image={'width': 6, 'height': 5, 'pixels': np.ravel(image)},
          sky={'width': 8, 'height': 6, 'pixels': np.ravel(sky)}, delta=delta,
          environments=environments)


TABLES = {'filters': filters, 'cameras': cameras, 'surfaces': surfaces,
          'uv_partials': uv_partials, 'textures': textures, 'lights': lights}

if __name__ == '__main__':
    for table in sys.argv[1:] or TABLES:
        TABLES[table]()
