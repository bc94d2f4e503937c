#!/usr/bin/env python3
"""Makes the meshes and images of the scenes of the gallery, scenes/gallery-*, from formulas (reference/gallery).

    make_gallery.py [SCENES_DIR [SCENE...]]

Everything is deterministic and made here, so the assets carry no licence but the project's. Needs numpy.
"""
import sys

from gallery.fog import fog
from gallery.materials import materials
from gallery.room import room
from gallery.shapes import shortened
from gallery.water import water
from make_assets import SCENES, write_png, write_serialized

GALLERY = {'gallery-room': room, 'gallery-water': water, 'gallery-fog': fog, 'gallery-materials': materials}


def main():
    for name in sys.argv[2:] or GALLERY:
        folder = SCENES / name
        (folder / 'meshes').mkdir(parents=True, exist_ok=True)
        parts, images = GALLERY[name]()
        for part, (points, normals, uvs, triangles) in parts.items():
            write_serialized(folder / 'meshes' / f'{part}.serialized',
                             (part, shortened(points, 16), shortened(normals, 12), shortened(uvs, 14), triangles))
        for file, image in images.items():
            write_png(folder / file, image)


if __name__ == '__main__':
    main()
