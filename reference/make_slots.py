#!/usr/bin/env python3
"""Asks Mitsuba 3 which texture it takes in which parameter, and how bright tiny images of them are.

    make_slots.py            writes reference/slots: slots.json and the files that its scenes read

Every texture stands in every parameter ("slot") that may be one. slots.json has the scenes in parts and, for what
Mitsuba takes, the mean of each colour channel with its standard error. What it refuses, or crashes on, is missing.
Needs mitsuba and numpy.
"""
import json
import subprocess
import sys
from pathlib import Path

import mitsuba as mi
import numpy as np

mi.set_variant('scalar_rgb')
mi.set_log_level(mi.LogLevel.Error)

FOLDER = Path(__file__).resolve().parent / 'slots'
SPP, SEEDS = 64, 8


def tag(kind, plugin, body=''):
    return f'<{kind} type="{plugin}" NAME>{body}</{kind}>'


def value(kind, name, text):
    return f'<{kind} name="{name}" value="{text}"/>'


def file(name):
    return value('string', 'filename', name)


PLACE = ('<transform name="to_world"><translate x="-0.5" y="-0.5" z="-0.5"/><scale value="2.5"/></transform>')
COLOUR = value('rgb', 'NAMED', '0.6, 0.3, 0.2')
TEXTURES = {
    'float': '<float NAME value="0.3"/>',
    'integer': '<integer NAME value="1"/>',
    'rgb': '<rgb NAME value="0.6, 0.3, 0.2"/>',
    'grey': '<rgb NAME value="0.3"/>',
    'spectrum': '<spectrum NAME value="0.3"/>',
    'wavelengths': '<spectrum NAME value="400:0.2, 500:0.3, 600:0.6, 700:0.5"/>',
    'bitmap': tag('texture', 'bitmap', file('rgb.png')),
    'bitmap, grey': tag('texture', 'bitmap', file('grey.png')),
    'bitmap, raw': tag('texture', 'bitmap', file('rgb.png') + value('boolean', 'raw', 'true')),
    'bitmap, raw and grey': tag('texture', 'bitmap', file('grey.png') + value('boolean', 'raw', 'true')
                                + value('string', 'filter_type', 'nearest')),
    'bitmap, float': tag('texture', 'bitmap', file('rgb.exr')),
    'checkerboard': tag('texture', 'checkerboard', COLOUR.replace('NAMED', 'color0')
                        + value('rgb', 'color1', '0.2, 0.5, 0.4')),
    'checkerboard of textures': tag('texture', 'checkerboard', tag('texture', 'bitmap', file('rgb.png')).replace(
        'NAME', 'name="color0"') + tag('texture', 'rawconstant', value('float', 'value', '0.3')).replace(
            'NAME', 'name="color1"')),
    'vertex colours': tag('texture', 'mesh_attribute', value('string', 'name', 'vertex_color')),
    'vertex numbers': tag('texture', 'mesh_attribute', value('string', 'name', 'vertex_w')),
    'face colours': tag('texture', 'mesh_attribute', value('string', 'name', 'face_c_color') + value('float', 'scale', '0.7')),
    'volume of colours': tag('texture', 'volume', tag('volume', 'gridvolume', file('colours.vol') + PLACE).replace(
        'NAME', 'name="volume"')),
    'volume of numbers': tag('texture', 'volume', tag('volume', 'gridvolume', file('numbers.vol') + PLACE).replace(
        'NAME', 'name="volume"')),
    'constant volume': tag('texture', 'volume', tag('volume', 'constvolume', COLOUR.replace('NAMED', 'value')).replace(
        'NAME', 'name="volume"')),
    'rawconstant number': tag('texture', 'rawconstant', value('float', 'value', '0.3')),
    'rawconstant vector': tag('texture', 'rawconstant', value('vector', 'value', '0.6, 0.45, 0.9')),
    'uniform': tag('texture', 'uniform', value('float', 'value', '0.3')),
    'srgb': tag('texture', 'srgb', COLOUR.replace('NAMED', 'color')),
    'd65': tag('texture', 'd65', COLOUR.replace('NAMED', 'color')),
    'd65 scale': tag('texture', 'd65', value('float', 'scale', '0.3')),
    'irregular': tag('texture', 'irregular', value('string', 'wavelengths', '400, 500, 600, 700')
                     + value('string', 'values', '0.2, 0.3, 0.6, 0.5')),
    'regular': tag('texture', 'regular', value('float', 'wavelength_min', '400') + value(
        'float', 'wavelength_max', '700') + value('string', 'values', '0.2, 0.3, 0.6, 0.5')),
    'blackbody': tag('texture', 'blackbody', value('float', 'temperature', '3000')),
    'spectrum plugin': tag('spectrum', 'uniform', value('float', 'value', '0.3')),
}

DIFFUSE = '<bsdf type="diffuse"><rgb name="reflectance" value="0.7, 0.5, 0.3"/></bsdf>'
METAL = '<bsdf type="roughconductor"><float name="alpha" value="0.2"/></bsdf>'
MESH = '<shape type="ply">' + file('mesh.ply') + '%s</shape>'
LAMPS = ('<emitter type="constant"><rgb name="radiance" value="0.5, 0.6, 0.7"/></emitter><shape type="sphere">'
         '<point name="center" value="1, 1.5, 2"/><float name="radius" value="0.5"/><emitter type="area">'
         '<rgb name="radiance" value="6, 5, 4"/></emitter></shape>')
FROM_ABOVE = '<transform name="to_world"><lookat origin="0.3, 0.2, 2" target="0, 0, 0" up="0, 1, 0"/></transform>'


def scene(integrator, content):
    return (f'<scene version="3.0.0"><integrator type="{integrator}"><integer name="max_depth" value="5"/></integrator>'
            '<sensor type="perspective"><float name="fov" value="40"/><transform name="to_world">'
            '<lookat origin="0.3, -2.6, 2" target="0, 0, 0" up="0, 0, 1"/></transform><film type="hdrfilm">'
            '<integer name="width" value="12"/><integer name="height" value="9"/><rfilter type="box"/>'
            f'<string name="pixel_format" value="rgb"/></film></sensor>{content}</scene>')


# What a slot's plugin is -> the scene around it.
SCENES = {
    'bsdf': scene('path', LAMPS + MESH % 'PLUGIN'),
    'emission': scene('path', LAMPS + MESH % ('PLUGIN' + DIFFUSE)),
    'beam': scene('ptracer', '<shape type="rectangle"><transform name="to_world"><translate z="-0.5"/></transform>'
                  + DIFFUSE + '</shape><shape type="rectangle"><transform name="to_world"><scale value="0.5"/>'
                  '<rotate x="1" angle="180"/><translate z="1"/></transform>PLUGIN</shape>'),
    'light': scene('path', 'PLUGIN' + MESH % DIFFUSE),
    'medium': scene('volpath', LAMPS + '<shape type="sphere"><float name="radius" value="0.9"/><bsdf type="null"/>'
                    'PLUGIN</shape>'),
    'hair': scene('path', LAMPS + '<shape type="linearcurve">' + file('curves.txt') + 'PLUGIN</shape>'),
}
SLOTS = {}


def slots(scene_name, plugin, parameters, body='', **bodies):
    """Parameters of a plugin, with what stands beside all, or beside one, of them."""
    kind = {'bsdf': 'bsdf', 'hair': 'bsdf', 'medium': 'medium'}.get(scene_name, 'emitter')
    name = ' name="interior"' if kind == 'medium' else ''
    for p in parameters.split():
        beside = bodies.get(p, '') + body
        SLOTS[f'{plugin}.{p}'] = (scene_name, f'<{kind} type="{plugin}"{name}>SLOT{beside}</{kind}>', p)


TINT = value('rgb', 'base_color', '0.7, 0.3, 0.2')
OTHER_ALPHA = {'alpha_u': value('float', 'alpha_v', '0.2'), 'alpha_v': value('float', 'alpha_u', '0.2')}
METAL_INDEX = {'eta': value('rgb', 'k', '2, 3, 4'), 'k': value('rgb', 'eta', '0.5, 0.7, 1')}
slots('bsdf', 'diffuse', 'reflectance')
slots('bsdf', 'conductor', 'specular_reflectance eta k', **METAL_INDEX)
slots('bsdf', 'roughconductor', 'specular_reflectance eta k alpha alpha_u alpha_v', **METAL_INDEX, **OTHER_ALPHA)
slots('bsdf', 'dielectric', 'specular_reflectance specular_transmittance int_ior')
slots('bsdf', 'thindielectric', 'specular_reflectance specular_transmittance')
slots('bsdf', 'roughdielectric', 'specular_reflectance specular_transmittance alpha alpha_u alpha_v int_ior', **OTHER_ALPHA)
slots('bsdf', 'plastic', 'diffuse_reflectance specular_reflectance')
slots('bsdf', 'roughplastic', 'diffuse_reflectance specular_reflectance alpha')
slots('bsdf', 'pplastic', 'diffuse_reflectance specular_reflectance alpha alpha_u alpha_v', **OTHER_ALPHA)
slots('bsdf', 'principled', 'base_color roughness metallic spec_trans eta specular sheen flatness clearcoat')
slots('bsdf', 'principled', 'anisotropic', value('float', 'metallic', '1') + value('float', 'roughness', '0.4'))
slots('bsdf', 'principled', 'spec_tint', TINT)
slots('bsdf', 'principled', 'sheen_tint', TINT + value('float', 'sheen', '1'))
slots('bsdf', 'principled', 'clearcoat_gloss', value('float', 'clearcoat', '1'))
slots('bsdf', 'principledthin', 'base_color roughness spec_trans sheen flatness diff_trans')
slots('bsdf', 'principledthin', 'anisotropic eta spec_tint', TINT + value('float', 'spec_trans', '0.7'))
slots('bsdf', 'principledthin', 'sheen_tint', TINT + value('float', 'sheen', '1'))
slots('bsdf', 'mask', 'opacity', DIFFUSE)
slots('bsdf', 'blendbsdf', 'weight', DIFFUSE + METAL)
slots('bsdf', 'bumpmap', 'height', METAL)
slots('bsdf', 'normalmap', 'normalmap', METAL)
slots('bsdf', 'polarizer', 'transmittance theta')
slots('bsdf', 'retarder', 'transmittance theta delta')
slots('bsdf', 'circular', 'transmittance theta')
slots('hair', 'hair', 'sigma_a')
slots('emission', 'area', 'radiance')
slots('beam', 'directionalarea', 'radiance')
slots('light', 'point', 'intensity', value('point', 'position', '0.3, 0.2, 1.2'))
slots('light', 'spot', 'intensity texture', FROM_ABOVE + value('float', 'cutoff_angle', '40'))
slots('light', 'projector', 'irradiance', FROM_ABOVE + value('float', 'fov', '45'))
slots('light', 'directional', 'irradiance', value('vector', 'direction', '0.3, 0.2, -1'))
slots('light', 'constant', 'radiance')
slots('light', 'envmap', 'scale', file('rgb.exr'))
slots('light', 'sunsky', 'albedo turbidity', value('vector', 'sun_direction', '0.3, 0.5, 0.6')
      + value('float', 'sun_scale', '0') + '<transform name="to_world"><rotate x="1" angle="90"/></transform>')
slots('medium', 'homogeneous', 'sigma_t albedo scale')
GRID = tag('volume', 'gridvolume', file('numbers.vol') + PLACE).replace('NAME', 'name="sigma_t"')
slots('medium', 'heterogeneous', 'sigma_t')
slots('medium', 'heterogeneous', 'albedo scale', GRID)


def nested(name, outer, parameter, scene_name='bsdf'):
    SLOTS[name] = (scene_name, outer, parameter)


nested('hg.g', '<medium type="homogeneous" name="interior"><phase type="hg">SLOT</phase></medium>', 'g', 'medium')
nested('blendphase.weight', '<medium type="homogeneous" name="interior"><phase type="blendphase">'
       '<phase type="isotropic"/><phase type="hg"><float name="g" value="0.8"/></phase>SLOT</phase></medium>',
       'weight', 'medium')
nested('constvolume.value', '<medium type="homogeneous" name="interior"><volume type="constvolume" name="albedo">'
       'SLOT</volume></medium>', 'value', 'medium')
for parameter in ['color0', 'color1']:
    nested(f'checkerboard.{parameter}', '<bsdf type="diffuse"><texture type="checkerboard" name="reflectance">SLOT'
           '</texture></bsdf>', parameter)
nested('checkerboard.color0 of a number', '<bsdf type="mask"><texture type="checkerboard" name="opacity">SLOT</texture>'
       + DIFFUSE + '</bsdf>', 'color0')
nested('volume.volume', '<bsdf type="diffuse"><texture type="volume" name="reflectance">SLOT</texture></bsdf>', 'volume')
nested('srgb.color', '<bsdf type="diffuse"><texture type="srgb" name="reflectance">SLOT</texture></bsdf>', 'color')
nested('d65.color', '<emitter type="constant"><texture type="d65" name="radiance">SLOT</texture></emitter>', 'color',
       'light')
nested('d65.color of a surface', '<emitter type="area"><texture type="d65" name="radiance">SLOT</texture></emitter>',
       'color', 'emission')


def text(slot, texture):
    scene_name, plugin, parameter = SLOTS[slot]
    return SCENES[scene_name].replace('PLUGIN', plugin).replace('SLOT', TEXTURES[texture]).replace(
        'NAME', f'name="{parameter}"')


def make_files():
    rng = np.random.default_rng(1)
    FOLDER.mkdir(exist_ok=True)
    cells = 4
    vertices, faces = [], []
    for y in range(cells + 1):
        for x in range(cells + 1):
            u, v = x / cells, y / cells
            vertices.append([2 * u - 1, 2 * v - 1, 0, u, v, *rng.uniform(0.2, 0.8, 4)])
    for y in range(cells):
        for x in range(cells):
            a = y * (cells + 1) + x
            b = a + cells + 1
            faces += [[3, a, a + 1, b + 1, *rng.uniform(0.2, 0.8, 3)], [3, a, b + 1, b, *rng.uniform(0.2, 0.8, 3)]]
    lines = ['ply', 'format ascii 1.0', f'element vertex {len(vertices)}']
    lines += [f'property float {p}' for p in 'x y z u v r g b w_x'.split()]
    lines += [f'element face {len(faces)}', 'property list uchar int vertex_indices']
    lines += [f'property float c_{c}' for c in 'rgb'] + ['end_header']
    lines += [' '.join(f'{v:.4g}' for v in row) for row in vertices + faces]
    (FOLDER / 'mesh.ply').write_text('\n'.join(lines) + '\n')
    colours = rng.integers(40, 240, (4, 4, 3)).astype(np.uint8)
    mi.Bitmap(colours).write(str(FOLDER / 'rgb.png'))
    mi.Bitmap(colours[:, :, :1].copy()).write(str(FOLDER / 'grey.png'))
    mi.Bitmap(rng.uniform(0.1, 0.9, (4, 4, 3)).astype(np.float32)).write(str(FOLDER / 'rgb.exr'))
    for name, channels in [('colours.vol', 3), ('numbers.vol', 1)]:
        data = b'VOL\x03' + np.array([1, 3, 3, 3, channels], np.int32).tobytes()
        data += np.array([0, 0, 0, 1, 1, 1], np.float32).tobytes()
        (FOLDER / name).write_bytes(data + rng.uniform(0.2, 0.8, 27 * channels).astype(np.float32).tobytes())
    curves = ['\n'.join(f'{0.4 * i - 0.8:.2f} {0.1 * k + 0.02 * i - 0.6:.2f} {0.05 * (i % 2):.2f} 0.04' for i in range(5))
              for k in range(12)]
    (FOLDER / 'curves.txt').write_text('\n\n'.join(curves) + '\n')


def ask(slot, texture):
    """Mean and standard error of each channel, or None."""
    path = FOLDER / 'scene.xml'
    path.write_text(text(slot, texture))
    try:
        loaded = mi.load_file(str(path))
        means = np.array([np.array(mi.render(loaded, spp=SPP, seed=seed + 1))[..., :3].astype(np.float64).mean((0, 1))
                          for seed in range(SEEDS)])
    except Exception:  # Mitsuba's own have no common base
        return None
    finally:
        path.unlink()
    if not np.isfinite(means).all():
        return None
    return [round(float(v), 6) for v in [*means.mean(0), *(means.std(0, ddof=1) / np.sqrt(SEEDS))]]


def answers():
    """Asks in another process, which may crash."""
    results = {slot: {} for slot in SLOTS}
    todo = [(slot, texture) for slot in SLOTS for texture in TEXTURES]
    while todo:
        child = subprocess.Popen([sys.executable, __file__, '--child', json.dumps(todo)], stdout=subprocess.PIPE, text=True)
        for line in child.stdout:
            (slot, texture), answer = todo.pop(0), json.loads(line)
            if answer is not None:
                results[slot][texture] = answer
        child.wait()
        if todo:
            print('crash:', *todo.pop(0), flush=True)
            (FOLDER / 'scene.xml').unlink(missing_ok=True)
    return results


def main():
    if sys.argv[1:2] == ['--child']:
        for slot, texture in json.loads(sys.argv[2]):
            print(json.dumps(ask(slot, texture)), flush=True)
        return
    make_files()
    table = {'mitsuba': mi.__version__, 'variant': mi.variant(), 'samples': SPP * SEEDS, 'scenes': SCENES,
             'slots': {name: {'scene': s, 'plugin': plugin, 'parameter': p} for name, (s, plugin, p) in SLOTS.items()},
             'textures': TEXTURES, 'results': answers()}
    (FOLDER / 'slots.json').write_text(json.dumps(table, indent=0, separators=(',', ':')).replace(
        ',\n', ',').replace('[\n', '[').replace('\n]', ']').replace('},', '},\n') + '\n')


if __name__ == '__main__':
    main()
