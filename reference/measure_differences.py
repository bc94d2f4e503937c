#!/usr/bin/env python3
"""Measures where Mitsuba is off: the figures of the last section of docs/compatibility.md.

    measure_differences.py [NAME...]       attribute-light-samples blend-delta bump-tangents direct-delta-lights
                                           elliptic-cylinders endless-media null-paths ray-offset-media ray-offset-surfaces sggx-flakes
                                           smooth-light-samples texture-light-samples

Needs the package mitsuba (3.9.1) with the variant llvm_ad_rgb. Each line is a scene, the mean of its image with its standard
error from six renders, and the ratio to what is due, where that is known.
"""
import pathlib
import sys
import tempfile

import mitsuba as mi
import numpy as np

mi.set_variant('llvm_ad_rgb')
T = mi.ScalarTransform4f
RENDERS = 6
PATH = {'type': 'path', 'max_depth': 50, 'rr_depth': 1000}
WHITE = {'type': 'constant', 'radiance': {'type': 'rgb', 'value': 1.0}}
MIRROR = {'type': 'conductor', 'material': 'none'}


def measure(name, spp, due=None, **scene):
    loaded = mi.load_dict({'type': 'scene', **scene})
    means = [float(np.array(mi.render(loaded, spp=spp, seed=i))[..., :3].mean()) for i in range(RENDERS)]
    mean, error = np.mean(means), np.std(means, ddof=1) / np.sqrt(RENDERS)
    ratio = f'  {mean / due:.4f} +- {error / due:.4f} of what is due' if due else ''
    print(f'{name:64s} {mean:.6f} +- {error:.6f}{ratio}', flush=True)
    return mean


def camera(fov=10, at=(0, 0, 4), near=0.01):
    film = {'type': 'hdrfilm', 'width': 8, 'height': 8, 'rfilter': {'type': 'box'}}
    return {'type': 'perspective', 'fov': fov, 'near_clip': near, 'film': film,
            'to_world': T().look_at(at, [0, 0, 0], [0, 1, 0])}


def grey(value):
    return {'type': 'diffuse', 'reflectance': {'type': 'rgb', 'value': value}}


def ball(name, bsdf, due=None, integrator=PATH):
    return measure(name, 512, due, integrator=integrator, sensor=camera(), light=WHITE, ball={'type': 'sphere', 'bsdf': bsdf})


def blends():
    def half(a, b):
        return {'type': 'blendbsdf', 'weight': 0.5, 'a': a, 'b': b}

    plastic = {'type': 'plastic', 'diffuse_reflectance': {'type': 'rgb', 'value': 0.0}}
    ball('half black, half mirror', half(grey(0.0), MIRROR), 0.5)
    for integrator in (PATH, {'type': 'direct'}, {**PATH, 'type': 'prb'}):
        ball(f'half grey, half mirror, {integrator["type"]}', half(grey(0.5), MIRROR), 0.75, integrator)
    ball('half grey, half white', half(grey(0.5), grey(1.0)), 0.75)
    alone = ball('black smooth plastic', plastic)
    ball('half white, half black smooth plastic', half(grey(1.0), plastic), (1 + alone) / 2)


def delta_lights():
    down = T().look_at([0, 0, 3], [0, 0, 0], [0, 1, 0])
    for light in ({'type': 'point', 'position': [0, 0, 3]}, {'type': 'directional', 'direction': [0, 0, -1]},
                  {'type': 'spot', 'to_world': down, 'cutoff_angle': 60.0}):
        scene = {'sensor': camera(), 'light': light, 'square': {'type': 'rectangle', 'bsdf': grey(0.5)}}
        due = measure(f'{light["type"]}, path', 256, integrator={'type': 'path', 'max_depth': 2}, **scene)
        for samples in (1, 2, 4):
            measure(f'{light["type"]}, direct, emitter_samples {samples}', 256, due,
                    integrator={'type': 'direct', 'emitter_samples': samples}, **scene)


def offsets_in_media():
    for radius in (1000, 1, 0.1, 0.01, 0.001):
        medium = {'type': 'homogeneous', 'albedo': 0.9, 'sigma_t': 10 / radius}
        measure(f'ball of radius {radius} and 10 free paths', 128, integrator={**PATH, 'type': 'volpath', 'max_depth': 100},
                sensor=camera(25, (0, 0, 4 * radius), radius / 1000), light=WHITE,
                ball={'type': 'sphere', 'radius': radius, 'bsdf': {'type': 'null'}, 'interior': medium})


def offsets_of_surfaces():
    for radius in (1, 0.1, 0.01, 0.001):
        floor = T().translate([0, -radius, 0]).rotate([1, 0, 0], -90).scale(3 * radius)
        measure(f'ball of radius {radius} on a floor', 128, integrator={**PATH, 'max_depth': 100},
                sensor=camera(40, (0, radius, 4 * radius), radius / 1000), light=WHITE,
                ball={'type': 'sphere', 'radius': radius, 'bsdf': grey(0.8)},
                floor={'type': 'rectangle', 'bsdf': grey(0.8), 'to_world': floor})


def flakes():
    for shape, matrix in (('ball', [1, 1, 1, 0, 0, 0]), ('flat', [1, 1, .1, 0, 0, 0]), ('long', [.1, .1, 1, 0, 0, 0])):
        grid = mi.VolumeGrid(np.array(matrix, np.float32).reshape(1, 1, 1, 6))
        volume = {'type': 'gridvolume', 'grid': grid, 'to_world': T().translate([-1, -1, -1]).scale(2)}
        medium = {'type': 'homogeneous', 'albedo': 1.0, 'sigma_t': 1.0, 'phase': {'type': 'sggx', 'S': volume}}
        for method in ('volpath', 'volpathmis'):
            measure(f'{shape} flakes, {method}', 128, 1, integrator={**PATH, 'type': method, 'max_depth': 200},
                    sensor=camera(40), light=WHITE,
                    cube={'type': 'cube', 'bsdf': {'type': 'null'}, 'interior': medium})


def null_paths():
    for opacity in (1.0, 0.5, 0.1):
        square = {'type': 'rectangle', 'bsdf': {'type': 'mask', 'opacity': opacity, 'nested': grey(0.5)}}
        scene = {'sensor': camera(), 'light': {'type': 'point', 'position': [0, 0, 3]}, 'square': square}
        due = measure(f'square of opacity {opacity}, volpath', 256, integrator={**PATH, 'type': 'volpath'}, **scene)
        measure(f'square of opacity {opacity}, path', 256, due, integrator=PATH, **scene)


def smooth_light_samples():
    square = """v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvn -{0} -{0} 1\nvn {0} -{0} 1\nvn {0} {0} 1\nvn -{0} {0} 1
f 1//1 2//2 3//3\nf 1//1 3//3 4//4\n"""
    for spread in (0, 0.2, 0.5):
        with tempfile.NamedTemporaryFile('w', suffix='.obj') as file:
            file.write(square.format(spread))
            file.flush()
            lamp = {'type': 'obj', 'filename': file.name, 'to_world': T().translate([0, 0, 1]).rotate([1, 0, 0], 180),
                    'light': {'type': 'area', 'radiance': {'type': 'rgb', 'value': 1.0}}}
            scene = {'sensor': camera(10, (0, -4, 0.5)), 'lamp': lamp, 'square': {'type': 'rectangle', 'bsdf': grey(0.5)}}
            due = measure(f'normals spread by {spread}, rays', 4096, **scene,
                          integrator={'type': 'direct', 'emitter_samples': 0, 'bsdf_samples': 1})
            measure(f'normals spread by {spread}, light samples', 4096, due, **scene,
                    integrator={'type': 'direct', 'emitter_samples': 1, 'bsdf_samples': 0})


def elliptic_cylinders():
    placed = T().translate([-.3, .2, .8]).rotate([0, 0, 1], 30).rotate([1, 0, 0], 40).scale([.6, .9, .7])
    scene = {'sensor': camera(40, (0, -4, 2)), 'floor': {'type': 'rectangle', 'bsdf': grey(0.5), 'to_world': T().scale(3)},
             'lamp': {'type': 'cylinder', 'to_world': placed, 'light': {'type': 'area', 'radiance': {'type': 'rgb', 'value': 1.0}}}}
    due = measure('cylinder, rays', 1024, **scene, integrator={'type': 'direct', 'emitter_samples': 0, 'bsdf_samples': 1})
    measure('cylinder, light samples', 1024, due, **scene,
            integrator={'type': 'direct', 'emitter_samples': 1, 'bsdf_samples': 0})


def texture_light_samples():
    pixels = mi.Bitmap(np.random.default_rng(1).random((6, 7, 3), np.float32))
    light = {'type': 'area', 'radiance': {'type': 'bitmap', 'bitmap': pixels, 'raw': True}}
    scene = {'sensor': camera(40, (0, -4, 2)), 'floor': {'type': 'rectangle', 'bsdf': grey(0.5), 'to_world': T().scale(3)},
             'lamp': {'type': 'cube', 'to_world': T().translate([0, 0, 1.2]).rotate([1, 0, 0], 30).scale(0.4), 'light': light}}
    due = measure('textured cube, rays', 1024, **scene, integrator={'type': 'direct', 'emitter_samples': 0, 'bsdf_samples': 1})
    measure('textured cube, light samples', 1024, due, **scene,
            integrator={'type': 'direct', 'emitter_samples': 1, 'bsdf_samples': 0})


def attribute_light_samples():
    light = {'type': 'area', 'radiance': {'type': 'mesh_attribute', 'name': 'vertex_color'}}
    scene = {'sensor': camera(40, (0, -4, 2)), 'floor': {'type': 'rectangle', 'bsdf': grey(0.5), 'to_world': T().scale(3)},
             'lamp': {'type': 'ply', 'filename': str(pathlib.Path(__file__).parent.parent / 'scenes/textures/attributes.ply'),
                      'to_world': T().translate([0, 0, 1.2]).rotate([1, 0, 0], 180), 'light': light}}
    due = measure('coloured disk, rays', 1024, **scene, integrator={'type': 'direct', 'emitter_samples': 0, 'bsdf_samples': 1})
    measure('coloured disk, path', 1024, due, **scene, integrator={'type': 'path', 'max_depth': 2})
    measure('coloured disk, light samples', 1024, due, **scene,
            integrator={'type': 'direct', 'emitter_samples': 1, 'bsdf_samples': 0})


def bump_tangents():
    heights = mi.Bitmap(np.random.default_rng(1).random((7, 5, 1), np.float32))
    for angle in (0, 30, 60, 90):
        turn = T().rotate([0, 0, 1], angle)
        brushed = {'type': 'roughconductor', 'material': 'none', 'alpha_u': 0.05, 'alpha_v': 0.4}
        bumps = {'type': 'bumpmap', 'scale': 0.3, 'heights': {'type': 'bitmap', 'bitmap': heights, 'raw': True}}
        lamp = turn @ T().translate([-1.5, -1, 4]).rotate([1, 0, 0], 160).scale(1.2)
        for name, nested in (('brushed metal', brushed), ('bumps', {**bumps, 'bsdf': {**brushed, 'alpha_u': 0.4}})):
            measure(f'{name}, scene turned by {angle} degrees', 512, integrator={'type': 'path', 'max_depth': 2},
                    sensor={**camera(38), 'to_world': turn @ T().look_at([0, -5, 2.6], [0, 0, 0], [0, 0, 1])},
                    lamp={'type': 'rectangle', 'to_world': lamp, 'light': {'type': 'area'}},
                    square={'type': 'rectangle', 'to_world': turn @ T().scale(1.5), 'bsdf': {**bumps, 'bsdf': nested}})


def endless_media():
    fog = mi.load_dict({'type': 'homogeneous', 'albedo': 0.5, 'sigma_t': 0.5})
    for name, x in (('ball behind it', 0), ('ball at a distance of 10', 10)):
        measure(name, 1024, integrator={**PATH, 'type': 'volpath'}, light=WHITE, sensor={**camera(25), 'medium': fog},
                square={'type': 'rectangle', 'bsdf': grey(0.5), 'exterior': fog},
                ball={'type': 'sphere', 'radius': 0.1, 'center': [x, 0, -0.2], 'exterior': fog})


ALL = {'attribute-light-samples': attribute_light_samples, 'blend-delta': blends, 'bump-tangents': bump_tangents, 'direct-delta-lights': delta_lights,
       'elliptic-cylinders': elliptic_cylinders, 'endless-media': endless_media, 'null-paths': null_paths, 'ray-offset-media': offsets_in_media,
       'ray-offset-surfaces': offsets_of_surfaces, 'sggx-flakes': flakes, 'smooth-light-samples': smooth_light_samples,
       'texture-light-samples': texture_light_samples}
for name in sys.argv[1:] or ALL:
    print(f'{name}:')
    ALL[name]()
