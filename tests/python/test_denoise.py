"""Denoised images and mattes in Python.

What has been loaded as Open Image Denoise stays loaded, so each library has a process of its own. The environment
variable DUET_FAKE_OIDN_LIBRARY names the library of tests/denoiser, which stands in for it.
"""
import importlib.util
import json
import os
import pathlib
import subprocess
import sys
import unittest
import unittest.mock

import duet
import numpy

from support import DuetTest, SCENE

BALL = SCENE.replace('<shape type="sphere"><bsdf type="diffuse"/>',
                     '<shape type="sphere" id="ball"><bsdf type="diffuse" id="paint"/>')
START = """
import sys
import duet
import numpy
scene = duet.load_file("scene.xml")
"""


def installed_library():
    """The path of Open Image Denoise's library, or None: where DUET_OIDN_LIBRARY says, or the package pyoidn has it."""
    if "DUET_OIDN_LIBRARY" in os.environ:
        return os.environ["DUET_OIDN_LIBRARY"]
    package = importlib.util.find_spec("pyoidn")
    if package is None:
        return None
    library = pathlib.Path(package.origin).parent / "oidn" / "lib" / "libOpenImageDenoise.so"
    return str(library) if library.exists() else None


class DenoiserTest(DuetTest):
    def run_with(self, library, code, **environment):
        """Runs code in a process of its own, in the folder of the scene."""
        done = subprocess.run([sys.executable, "-W", "error", "-c", START + code], cwd=self.folder, text=True,
                              capture_output=True,
                              env={**os.environ, "DUET_OIDN_LIBRARY": str(library), **environment})
        self.assertEqual(done.returncode, 0, done.stderr)


class WithoutDenoiser(DenoiserTest):
    def test_an_image_has_no_denoised_one_unless_it_is_asked_for(self):
        self.assertIsNone(duet.render(duet.load_file(self.file)).denoised)

    def test_a_missing_library_is_an_error_before_rendering(self):
        self.run_with(self.folder / "none.so", f"""
try:
    duet.render(scene, denoise=True, spp={2**30})
except duet.DenoiserError as error:
    assert isinstance(error, RuntimeError)
    assert "Open Image Denoise cannot be loaded" in str(error) and "none.so" in str(error), error
else:
    sys.exit("no error")
""")


@unittest.skipUnless("DUET_FAKE_OIDN_LIBRARY" in os.environ,
                     "DUET_FAKE_OIDN_LIBRARY does not say where the library of tests/denoiser is")
class WithStandIn(DenoiserTest):
    """Its output is colour + 10 albedo + 100 normal."""

    def test_the_denoised_image_and_its_label(self):
        self.run_with(os.environ["DUET_FAKE_OIDN_LIBRARY"], """
plain = duet.render(scene, spp=1)
image = duet.render(scene, spp=1, denoise=True)
assert image.channels == plain.channels == ["R", "G", "B", "A"]
assert (numpy.asarray(image) == numpy.asarray(plain)).all()
clean = image.denoised
assert isinstance(clean, duet.Image) and clean.denoised is None
assert clean.shape == image.shape and clean.channels == image.channels
layers = duet.render(scene, spp=1, denoise=True, aovs="denoise_albedo,denoise_normal")
assert layers.channels[4:] == ["denoise_albedo.R", "denoise_albedo.G", "denoise_albedo.B",
                               "denoise_normal.X", "denoise_normal.Y", "denoise_normal.Z"]
given = numpy.asarray(layers)
expected = given[..., :3] + 10 * given[..., 4:7].clip(0, 1) + 100 * given[..., 7:]
numpy.testing.assert_allclose(numpy.asarray(clean)[..., :3], expected, rtol=1e-5, atol=1e-5)
numpy.testing.assert_array_equal(clean[..., 3], image[..., 3])
assert clean.metadata["denoiser"] == "Open Image Denoise 2.99.7"
assert "denoised by Open Image Denoise" in clean.metadata["bias"], clean.metadata
assert "denoiser" not in image.metadata and "bias" not in image.metadata
clean.save("clean.exr")
assert duet.compare("clean.exr", clean)["rmse"] == 0
variance = numpy.full((16, 24), 1e-3)
for denoised in [clean, "clean.exr"]:
    assert "warning" not in duet.compare(denoised, plain)
    tested = duet.compare(denoised, plain, variance=variance, image_spp=1)
    assert "denoised by Open Image Denoise 2.99.7 and is biased" in tested["warning"], tested
assert "warning" not in duet.compare(image, plain, variance=variance)
mattes = duet.render(scene, spp=1, denoise=True, cryptomatte=["object"])
assert mattes.denoised.channels == ["R", "G", "B", "A"]
assert not any(name.startswith("cryptomatte") for name in mattes.denoised.metadata)
try:
    duet.render(scene, denoise=True, integrator="aov", aovs=["depth"])
except ValueError as error:
    assert "no colours to denoise" in str(error), error
else:
    sys.exit("no error")
""")

    def test_if_the_denoiser_fails_the_image_is_there_nevertheless(self):
        self.run_with(os.environ["DUET_FAKE_OIDN_LIBRARY"], """
image = duet.render(scene, denoise=True)
assert image.shape == (16, 24, 4)
try:
    image.denoised
except duet.DenoiserError as error:
    assert "out of memory" in str(error), error
else:
    sys.exit("no error")
""", DUET_FAKE_OIDN="filter")


@unittest.skipIf(installed_library() is None, "Open Image Denoise is not installed (pip install pyoidn)")
class WithOpenImageDenoise(DenoiserTest):
    def test_the_denoised_image_is_that_of_the_program(self):
        library = installed_library()
        with unittest.mock.patch.dict(os.environ, DUET_OIDN_LIBRARY=library):
            self.program("--denoise", "--spp", "4")
        self.run_with(library, """
image = duet.render(scene, spp=4, denoise=True)
clean = image.denoised
assert clean.metadata["denoiser"].startswith("Open Image Denoise 2."), clean.metadata
assert duet.compare(clean, "program.denoised.exr")["rmse"] == 0
reference = duet.render(scene, spp=4096, seed=1)
noisy, denoised = (duet.compare(i, reference)["relmse"] for i in (image, clean))
assert denoised < 0.7 * noisy, (noisy, denoised)
""")


class Mattes(DuetTest):
    def setUp(self):
        super().setUp()
        self.file.write_text(BALL)

    def test_mattes_are_those_of_the_program(self):
        image = duet.render(duet.load_file(self.file), cryptomatte=["material", "object"])
        self.assertEqual(image.shape, (16, 24, 4 + 24))
        self.assertEqual(image.channels[4:7], ["CryptoObject00.R", "CryptoObject00.G", "CryptoObject00.B"])
        self.assertEqual(image.channels[-1], "CryptoMaterial02.A")
        image.save(self.folder / "own.exr")
        program = self.program("--cryptomatte", "object,material")
        # The rest of the headers differs: command line, date.
        own, others = ((self.folder / "own.exr").read_bytes(), program.read_bytes())
        for name, value in image.metadata.items():
            if name.startswith("cryptomatte/"):
                self.assertIn(value.encode(), own)
                self.assertIn(value.encode(), others)
        self.assertEqual(duet.compare(program, image)["rmse"], 0)

    def test_ids_and_coverages(self):
        scene = duet.load_dict({
            "type": "scene", "integrator": {"type": "path"},
            "sensor": {"type": "perspective", "fov": 45, "film": {"type": "hdrfilm", "width": 12, "height": 8},
                       "to_world": duet.Transform4f.look_at(origin=[0, 0, 4], target=[0, 0, 0], up=[0, 1, 0])},
            "ball": {"type": "sphere", "bsdf": {"type": "diffuse"}}, "sky": {"type": "constant"}})
        image = duet.render(scene, spp=16, cryptomatte="object")
        first = image.channels.index("CryptoObject00.R")
        ids = numpy.ascontiguousarray(image[..., first]).view(numpy.uint32)
        coverage = image[..., first + 1]
        manifest = next(v for name, v in image.metadata.items() if name.endswith("/manifest"))
        ball = int(json.loads(manifest)["ball"], 16)
        self.assertEqual((ids[4, 6], coverage[4, 6]), (ball, 1))
        self.assertEqual((ids[0, 0], coverage[0, 0]), (0, 0))
        self.assertTrue(((0 <= coverage) & (coverage <= 1)).all())
        # The share that the ball covers is that of the circle that it looks like, of sin = 1/4 at a distance of 4.
        half_width = numpy.tan(numpy.radians(45 / 2))
        circle = numpy.pi * (1 / 15) / (2 * half_width) ** 2 * 12 * 12
        self.assertAlmostEqual(float(coverage.sum()) / circle, 1, delta=0.03)

    def test_what_there_is_not(self):
        scene = duet.load_file(self.file)
        with self.assertRaisesRegex(ValueError, 'no mattes of "asset"; there are object material'):
            duet.render(scene, cryptomatte=["asset"])
        with self.assertRaises(TypeError):
            duet.render(scene, cryptomatte=[1])


if __name__ == "__main__":
    unittest.main()
