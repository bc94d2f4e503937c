"""The Python package: the images of the program, bit for bit, and errors that say what is wrong."""
import os
import re
import signal
import subprocess
import tempfile
import threading
import unittest
import warnings

import duet
import numpy

from support import PROGRAM, ROOT, SCENE, DuetTest

#: It takes a while, and has many samples in a second.
ENDLESS = 2**30


class ImagesOfTheProgram(DuetTest):
    def test_the_same_bits_by_every_method(self):
        scene = duet.load_file(self.file)
        for method in ["path", "volpath", "bdpt", "vcm", "ppm", "ptracer", "auto"]:
            with self.subTest(method=method), warnings.catch_warnings():
                warnings.simplefilter("ignore", duet.SceneWarning)
                image = duet.render(scene, integrator=method, seed=3, spp=6, parameters={"max_depth": 4}, threads=1)
                self.assert_equal_files(image, self.program("-i", method, "--seed", "3", "--spp", "6", "-I",
                                                            "max_depth=4", "-t", "2"))

    def test_defines_size_crop_and_layers(self):
        image = duet.render(duet.load_file(self.file, spp=2), size=(32, 20), crop=(4, 2, 20, 9), aovs=["depth", "albedo"])
        self.assertEqual(image.shape[:2], (9, 20))
        self.assertEqual(image.channels[:4], ["R", "G", "B", "A"])
        self.assertTrue(any(c.startswith("depth") for c in image.channels))
        self.assertEqual(image.metadata["spp"], 2)
        self.assert_equal_files(image, self.program("-D", "spp=2", "--size", "32x20", "--crop", "4,2,20,9", "--aov",
                                                    "depth,albedo"))

    def test_dictionaries_are_the_scene_that_they_describe(self):
        look_at = [[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 4], [0, 0, 0, 1]]
        scene = duet.load_dict({
            "type": "scene",
            "integrator": {"type": "path", "max_depth": 5},
            "sensor": {"type": "perspective", "to_world": numpy.array(look_at),
                       "sampler": {"type": "independent", "sample_count": 4},
                       "film": {"type": "hdrfilm", "width": 24, "height": 16, "component_format": "float32"}},
            "white": {"type": "diffuse", "reflectance": {"type": "rgb", "value": [0.5, 0.5, 0.5]}},
            "ball": {"type": "sphere", "radius": 1, "bsdf": {"type": "ref", "id": "white"}},
            "lamp": {"type": "point", "position": [2, 3, 4], "intensity": {"type": "rgb", "value": [20, 10, 5]}},
            "sky": {"type": "constant", "radiance": 0.2},
        })
        self.assert_equal_files(duet.render(scene), self.program())

    def test_programs_for_mitsuba(self):
        """The steps of Mitsuba 3's quick start, with the import changed."""
        mi = duet
        mi.set_variant("scalar_rgb")
        self.assertIn(mi.variant(), mi.variants())
        with self.assertRaisesRegex(TypeError, "a variant is a str, not NoneType"):
            mi.set_variant(None)
        with self.assertRaisesRegex(ValueError, "scalar_spectral"):
            mi.set_variant("scalar_spectral")
        image = mi.render(mi.load_file(self.file), spp=4)
        shown = image ** (1 / 2.2)
        self.assertEqual((type(shown), shown.shape), (numpy.ndarray, image.shape))
        mi.util.write_bitmap(self.folder / "a.exr", image)
        mi.util.write_bitmap(self.folder / "b.exr", numpy.asarray(image)[:, :, :3])
        mi.util.write_bitmap(self.folder / "grey.png", image[:, :, 0])
        self.assertEqual(duet.compare(self.folder / "a.exr", self.folder / "b.exr")["rmse"], 0)
        self.assert_equal_files(image, self.folder / "b.exr")

    def test_the_cornell_box_is_mitsubas(self):
        """The means of its quarters are those of Mitsuba 3.9's image (llvm_ad_rgb, 512 samples); noise here is 0.3 % to 1 %."""
        box = duet.cornell_box()
        box["sensor"]["film"]["rfilter"] = {"type": "box"}
        image = numpy.asarray(duet.render(duet.load_dict(box), size=(128, 128), spp=32))[..., :3]
        quarters = image.reshape(2, 64, 2, 64, 3).mean(axis=(1, 3))
        numpy.testing.assert_allclose(quarters, [[[0.40486, 0.21927, 0.10193], [0.34458, 0.24732, 0.10398]],
                                                 [[0.13238, 0.04084, 0.01747], [0.07866, 0.05699, 0.01650]]], rtol=0.03)
        self.assertEqual(duet.cornell_box()["sensor"]["film"]["rfilter"], {"type": "gaussian"})

    def test_transforms(self):
        T = duet.ScalarTransform4f
        look = T().look_at(origin=[0, 0, 4], target=[0, 0, 0], up=[0, 1, 0])
        numpy.testing.assert_allclose(look.matrix, [[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 4], [0, 0, 0, 1]])
        # The step that is named last comes first, on the class, too.
        step = T.translate([1, 2, 3]).rotate([0, 0, 2], 90).scale(2)
        numpy.testing.assert_allclose(step.matrix @ [1, 0, 0, 1], [1, 4, 3, 1], atol=1e-15)
        numpy.testing.assert_allclose((step @ step.inverse()).matrix, numpy.eye(4), atol=1e-15)
        for wrong in [lambda: T.look_at([0, 0, 0], [0, 1, 0], [0, 1, 0]), lambda: T.rotate([0, 0, 0], 1),
                      lambda: T.translate([1, 2]), lambda: T(numpy.eye(3))]:
            with self.assertRaises(ValueError):
                wrong()
        ball = {"type": "scene", "integrator": {"type": "path"}, "ball": {"type": "sphere", "to_world": step}}
        self.assertIn("sphere", str(duet.load_dict({**ball, "sensor": {"type": "perspective", "to_world": look}})))

    def test_raw_films_are_merged(self):
        films = []
        for k in (1, 2):
            films.append(self.folder / f"{k}.exr")
            subprocess.run([PROGRAM, str(self.file), "-q", "--slice", f"{k}/2", "--raw", str(films[-1])], check=True)
        self.assert_equal_files(duet.merge(films), self.program())
        with self.assertRaisesRegex(OSError, "overlap"):
            duet.merge([films[0], films[0]])
        with self.assertRaises(OSError):
            duet.merge([self.file])


class Images(DuetTest):
    def test_pixels_are_not_copied_and_outlive_the_image(self):
        image = duet.render(duet.load_string(SCENE))
        pixels = numpy.asarray(image)
        self.assertTrue(numpy.shares_memory(pixels, numpy.asarray(image)))
        self.assertFalse(pixels.flags.writeable)
        self.assertEqual((pixels.shape, pixels.dtype), ((16, 24, 4), numpy.float32))
        before = pixels.copy()
        del image
        self.assertTrue((pixels == before).all())

    def test_calculations(self):
        image = duet.Image.from_array(numpy.full((2, 3, 3), 0.5))
        before = numpy.asarray(image).copy()
        for result in [image * 2, 2 * image, image + image, -image, numpy.sqrt(image)]:
            self.assertEqual((type(result), result.shape), (numpy.ndarray, image.shape))
        self.assertTrue((numpy.add(image, image, out=numpy.zeros((2, 3, 4))) == 2 * before).all())
        self.assertEqual(numpy.add.reduce(image, axis=2, where=image > 0.7)[0, 0], 1)
        in_place = image
        with self.assertRaisesRegex(ValueError, "read-only"):
            in_place *= 2
        for wrong in [lambda: numpy.add(image, 1, out=image), lambda: numpy.add.at(image, 0, 1)]:
            with self.assertRaises(ValueError):
                wrong()
        numpy.testing.assert_array_equal(image, before)

    def test_files(self):
        image = duet.render(duet.load_string(SCENE))
        for name in ["a.exr", "a.png", "a.jpg"]:
            image.save(self.folder / name)
            self.assertGreater((self.folder / name).stat().st_size, 100)
        image.save(self.folder / "agx.png", exposure="auto", tonemap="agx")
        self.assertNotEqual((self.folder / "agx.png").read_bytes(), (self.folder / "a.png").read_bytes())
        image.save(self.folder / "deep.png", png_depth=16)
        self.assertEqual((self.folder / "a.png").read_bytes()[24], 8)  # the bit depth in the IHDR chunk
        self.assertEqual((self.folder / "deep.png").read_bytes()[24], 16)
        with self.assertRaisesRegex(ValueError, "8 or 16 bits, not 12"):
            image.save(self.folder / "a.png", png_depth=12)
        image.save(self.folder / "blender.exr", aov_names="blender", exr_parts=True)
        self.assertIn(b"ViewLayer.Combined", (self.folder / "blender.exr").read_bytes())
        self.assertEqual(duet.compare(self.folder / "blender.exr", self.folder / "a.exr")["rmse"], 0)
        with self.assertRaisesRegex(ValueError, "there are duet blender nuke mitsuba"):
            image.save(self.folder / "a.exr", aov_names="houdini")
        with self.assertRaisesRegex(ValueError, "there are srgb aces agx reinhard"):
            image.save(self.folder / "a.png", tonemap="filmic")
        with self.assertRaisesRegex(ValueError, "\"auto\", not 'bright'"):
            image.save(self.folder / "a.png", exposure="bright")
        self.assertEqual(image._repr_png_(), (self.folder / "a.png").read_bytes())
        with self.assertRaisesRegex(ValueError, "a.txt"):
            image.save(self.folder / "a.txt")
        with self.assertRaisesRegex(OSError, "cannot be written"):
            image.save(self.folder / "no" / "a.exr")

    def test_compare(self):
        image = duet.render(duet.load_string(SCENE), spp=16)
        pixels = numpy.asarray(image)
        brighter = duet.compare(pixels * 1.1, image)
        numpy.testing.assert_allclose(brighter["mean_ratio"], 1.1, rtol=1e-4)
        self.assertIsInstance(brighter["verdict"], str)
        tested = duet.compare(image, image, variance=numpy.full((16, 24), 1e-3))
        self.assertIn("bias_test", tested)
        with self.assertRaisesRegex(ValueError, "image_spp"):
            duet.compare(pixels, image, variance=pixels)
        for wrong in [numpy.zeros((2, 2, 2)), numpy.zeros(3), numpy.zeros((0, 4, 3))]:
            with self.assertRaises(ValueError):
                duet.compare(wrong, image)
        with self.assertRaises(ValueError):
            duet.compare(pixels[:4], image)
        with self.assertRaises(TypeError):
            duet.compare("text and no file".split(), image)
        with self.assertRaises(OSError):
            duet.compare(self.folder / "none.exr", image)


class WhatGoesWrong(DuetTest):
    def test_errors_in_scenes_have_a_place(self):
        self.file.write_text(SCENE.replace('"sphere"', '"spere"'))
        with self.assertRaises(duet.SceneError) as caught:
            duet.load_file(self.file)
        error = caught.exception
        self.assertEqual((error.file, error.line), (str(self.file), 10))
        self.assertGreater(error.column, 0)
        self.assertIn('did you mean "sphere"', str(error))
        self.assertEqual(len(error.messages), 1)
        with self.assertRaisesRegex(duet.SceneError, "none.xml"):
            duet.load_file(self.folder / "none.xml")
        with self.assertRaises(duet.SceneError):
            duet.load_string("no scene")

    def test_types_and_values(self):
        scene = duet.load_string(SCENE)
        for settings in [{"spp": 1.5}, {"spp": True}, {"time": "1s"}, {"size": 3}, {"crop": (0, 0, 1, "1")}]:
            with self.subTest(settings=settings), self.assertRaises(TypeError):
                duet.render(scene, **settings)
        for settings in [{"spp": 0}, {"spp": 2**40}, {"time": -1}, {"size": (1,)}, {"size": (0, 4)}, {"seed": -1},
                         {"integrator": "pth"}, {"parameters": {"max_dept": 3}}, {"aovs": ["dept"]},
                         {"techniques": "some"}, {"techniques": "raw"}]:
            with self.subTest(settings=settings), self.assertRaises(ValueError):
                duet.render(scene, **settings)
        for settings in [{"sensor": 1}, {"crop": (0, 0, 100, 100)}]:
            with self.subTest(settings=settings), self.assertRaises(IndexError):
                duet.render(scene, **settings)
        with self.assertRaises(TypeError):
            duet.render(str(self.file))
        with self.assertRaises(TypeError):
            duet.load_file(3)
        with self.assertRaises(TypeError):
            duet.load_file(self.file, spp=[1])

    def test_dictionaries(self):
        for wrong in [[], {"type": "sphere"}, {"type": "scene", "a": {"type": "nothing"}},
                      {"type": "scene", "a": {"radius": 1}},
                      {"type": "scene", "a": {"type": "sphere", "to_world": numpy.eye(3)}},
                      {"type": "scene", "a": {"type": "sphere", "center": object()}}]:
            with self.subTest(scene=wrong), self.assertRaises((TypeError, ValueError)):
                duet.load_dict(wrong)
        with self.assertRaises(duet.SceneError):
            duet.load_dict({"type": "scene", "a": {"type": "sphere", "radus": 1}})

    def test_memory(self):
        scene = duet.load_string(SCENE)
        os.environ["DUET_MEMORY_LIMIT"] = "300000000"
        self.addCleanup(os.environ.pop, "DUET_MEMORY_LIMIT")
        with self.assertRaisesRegex(MemoryError, "the limit is 300 MB"):
            duet.render(scene, size=(4000, 4000))


class Watching(DuetTest):
    def test_ctrl_c_gets_the_image_so_far(self):
        # Shells have what they start in the background ignore Ctrl-C.
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.default_int_handler))
        scene = duet.load_string(SCENE)

        def press(_fraction, spp, _seconds):
            if spp >= 2:
                signal.raise_signal(signal.SIGINT)

        image = duet.render(scene, spp=ENDLESS, progress=press)
        self.assertTrue(image.interrupted)
        self.assertGreaterEqual(image.metadata["spp"], 1)
        timer = threading.Timer(1, signal.raise_signal, [signal.SIGINT])
        timer.start()
        self.assertTrue(duet.render(scene, spp=ENDLESS).interrupted)
        timer.join()

    def test_an_exception_of_the_watcher_ends_the_render(self):
        def fail(*_):
            raise LookupError("enough")
        with self.assertRaisesRegex(LookupError, "enough"):
            duet.render(duet.load_string(SCENE), spp=ENDLESS, progress=fail)

    def test_threads_render_one_scene_at_once(self):
        scene = duet.load_string(SCENE)
        images = []
        threads = [threading.Thread(target=lambda s=seed: images.append(duet.render(scene, seed=s % 2, threads=1)))
                   for seed in range(6)]
        for thread in threads:
            thread.start()
        del scene
        for thread in threads:
            thread.join()
        self.assertEqual(len({numpy.asarray(i).tobytes() for i in images}), 2)

    def test_warnings(self):
        text = SCENE.replace('type="path"', 'type="path" id="a"').replace(
            '<sampler type="independent">', '<sampler type="halton">')
        with self.assertWarnsRegex(duet.SceneWarning, "halton"):
            duet.render(duet.load_string(text), strict_sampler=True)

    def test_info(self):
        scene = duet.load_file(self.file)
        self.assertIn("sensors", scene.info())
        self.assertIn("sphere", str(scene))
        self.assertEqual(scene.warnings, [])


class Documentation(unittest.TestCase):
    def test_welch(self):
        # t = 0.5 / sqrt(5 / 12) with three degrees of freedom; then with the variance known, which adds up.
        test = duet.welch([1, 2, 3, 4], 2)
        self.assertAlmostEqual(test.difference, 0.5)
        self.assertAlmostEqual(test.error, (5 / 12) ** 0.5)
        self.assertAlmostEqual(test.p, 0.49503, 4)
        self.assertAlmostEqual(test.z, 0.68233, 4)
        self.assertAlmostEqual(duet.welch(numpy.ones(9), 2, 0.25).p, 0.0455, 4)
        self.assertLess(duet.welch([1, 2, 3, 4], 9).p, 0.01)
        with self.assertRaises(ValueError):
            duet.welch([1], 2)

    def test_the_tutorial_runs(self):
        """The code of docs/python.md, from top to bottom, in an empty folder with the scene that it speaks of."""
        text = (ROOT / "docs" / "python.md").read_text()
        code = "\n".join(re.findall(r"```python\n(.*?)```", text, re.S))
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            self.addCleanup(os.chdir, before)
            os.symlink(ROOT / "scenes", "scenes")
            exec(compile(code, "docs/python.md", "exec"), {})
            self.assertTrue(os.path.exists("cornell-box.exr"))
            os.chdir(before)


if __name__ == "__main__":
    unittest.main()
