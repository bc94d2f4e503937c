"""The scene, the program and the folder of the tests of the Python package.

The environment variable DUET_PROGRAM names the program.
"""
import os
import pathlib
import subprocess
import tempfile
import unittest

import duet

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("DUET_PROGRAM", str(ROOT / "build" / "duet"))

SCENE = """<scene version="3.0.0">
  <default name="spp" value="4"/>
  <integrator type="path"><integer name="max_depth" value="5"/></integrator>
  <sensor type="perspective">
    <transform name="to_world"><lookat origin="0, 0, 4" target="0, 0, 0" up="0, 1, 0"/></transform>
    <sampler type="independent"><integer name="sample_count" value="$spp"/></sampler>
    <film type="hdrfilm"><integer name="width" value="24"/><integer name="height" value="16"/>
      <string name="component_format" value="float32"/></film>
  </sensor>
  <shape type="sphere"><bsdf type="diffuse"/></shape>
  <emitter type="point"><point name="position" value="2, 3, 4"/><rgb name="intensity" value="20, 10, 5"/></emitter>
  <emitter type="constant"><float name="radiance" value="0.2"/></emitter>
</scene>"""


class DuetTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.file = self.folder / "scene.xml"
        self.file.write_text(SCENE)

    def program(self, *arguments):
        image = self.folder / "program.exr"
        subprocess.run([PROGRAM, str(self.file), "-q", "-o", str(image), *arguments], check=True)
        return image

    def assert_equal_files(self, image, file):
        """That the pixels of an image are those of a file, which float32 keeps."""
        own = self.folder / "own.exr"
        image.save(own)
        figures = duet.compare(own, file)
        self.assertEqual(figures["rmse"], 0)
        self.assertEqual(duet.compare(image, file)["rmse"], 0)
