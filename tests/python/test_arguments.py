"""Arguments of wrong types and values: each is an exception that names what is wrong, and where in a dictionary."""
import os
import subprocess
import sys
import unittest

import duet
import numpy

from support import SCENE, DuetTest

BASE = {"type": "scene", "integrator": {"type": "path"},
        "sensor": {"type": "perspective", "film": {"type": "hdrfilm", "width": 8, "height": 8}},
        "sky": {"type": "constant"}}
HUGE = 10**400


class Settings(DuetTest):
    def test_of_renders(self):
        scene = duet.load_string(SCENE)
        types = {"threads": None, "sensor": None, "integrator": [3, {"type": "path"}, b"path"], "aovs": [3, None, [1], b"depth"],
                 "cryptomatte": [None, True], "techniques": [], "parameters": [[1], "max_depth=3", {1: 2}, {"max_depth": None}],
                 "seed": [True, 1.0, "1", numpy.bool_(True)], "denoise": ["no", 1], "strict_sampler": 1, "size": ["8x8", 3],
                 "crop": [{1, "a", 2, 3}], "spp": [numpy.bool_(True), "4"], "progress": [3, "yes"]}
        for name, wrong in types.items():
            for value in wrong if isinstance(wrong, list) else [wrong]:
                with self.subTest(name=name, value=value), self.assertRaisesRegex(TypeError, name):
                    duet.render(scene, **{"spp": 1, name: value})
        values = {"threads": [-1, 1025, 2**31 - 1], "sensor": [-1], "time": [HUGE, float("nan"), 0], "spp": [-1, 2**31 - 1],
                  "target_error": [float("nan"), 0, float("inf")], "size": [(0, 1), (65537, 1), (1, 2**40)],
                  "crop": [(-1, 0, 3, 3), (0, 0, 0, 3)], "seed": [-1, 2**64], "aovs": [["\ud800"], ""],
                  "techniques": [["raw"]], "integrator": ["\udcff"]}
        for name, wrong in values.items():
            for value in wrong:
                with self.subTest(name=name, value=value), self.assertRaises(ValueError) as caught:
                    duet.render(scene, **{"spp": 1, name: value})
                self.assertNotIn("incompatible function arguments", str(caught.exception))
        with self.assertRaises(IndexError):
            duet.render(scene, crop=(2**31 - 1, 0, 2**31 - 1, 3))

    def test_numbers_of_numpy(self):
        scene = duet.load_string(SCENE, spp=numpy.int64(3))
        self.assertEqual(duet.render(scene).metadata["spp"], 3)
        image = duet.render(scene, spp=numpy.array(2), seed=numpy.uint64(2**63), size=numpy.array([8, 8]),
                            time=numpy.float32(60), integrator="path", denoise=numpy.bool_(False),
                            parameters={"max_depth": numpy.int64(3), "hide_emitters": numpy.bool_(True)})
        self.assertEqual((image.metadata["spp"], image.shape), (2, (8, 8, 4)))
        image.save(self.folder / "a.png", exposure=numpy.float32(1), png_depth=numpy.int64(16))

    def test_of_scenes(self):
        # "path" is a name that a scene may define, as others are.
        text = SCENE.replace("<default", '<default name="path" value="1"/><default', 1)
        self.file.write_text(text)
        self.assertIn("$path = 2", str(duet.load_file(self.file, path=2)))
        for wrong in [lambda: duet.load_file(b"scene.xml"), lambda: duet.load_string(b"<scene/>"), lambda: duet.load_file(3),
                      lambda: duet.load_string(SCENE, spp=None), lambda: duet.load_file(self.file, search_paths=3),
                      lambda: duet.load_file(self.file, search_paths=b"a"), lambda: duet.merge(None), lambda: duet.merge([1])]:
            with self.assertRaises(TypeError) as caught:
                wrong()
            self.assertNotIn("incompatible function arguments", str(caught.exception))
        for text in [lambda: duet.load_string("\ud800"), lambda: duet.load_file("\udcff.xml"),
                     lambda: duet.load_string(SCENE, spp="\ud800")]:
            with self.assertRaisesRegex(ValueError, "surrogate"):
                text()

    def test_of_files(self):
        image = duet.Image.from_array(numpy.full((4, 4, 3), 0.2))
        for wrong in [{"exr_parts": 1}, {"aov_names": None}, {"png_depth": 16.0}, {"png_depth": "16"}, {"exposure": None},
                      {"exposure": True}, {"exposure": [1]}, {"tonemap": 3}]:
            with self.subTest(wrong), self.assertRaisesRegex(TypeError, next(iter(wrong))):
                image.save(self.folder / "a.png", **wrong)
        with self.assertRaisesRegex(TypeError, "path is a str or a path object, not bytes"):
            image.save(os.fsencode(self.folder / "a.png"))
        for exposure in [float("nan"), 1e9, -101, numpy.inf, "auto+101", "auto2", "auto+", "autox", "2"]:
            with self.subTest(exposure), self.assertRaisesRegex(ValueError, "exposure: "):
                image.save(self.folder / "a.png", exposure=exposure)
        self.assertEqual(list(self.folder.glob("*.png")), [])
        files = {}
        for name, exposure in {"auto": "auto", "same": "auto+0", "brighter": "auto+1", "darker": "auto-1.5"}.items():
            image.save(self.folder / f"{name}.png", exposure=exposure)
            files[name] = (self.folder / f"{name}.png").read_bytes()
        self.assertEqual(files["auto"], files["same"])
        self.assertEqual(len(set(files.values())), 3)

    def test_paths_with_a_zero_byte_name_no_other_file(self):
        image = duet.Image.from_array(numpy.ones((4, 4, 3)))
        image.save(self.folder / "a.exr")
        cut = str(self.folder / "a.exr") + "\0"
        for call in [lambda: image.save(str(self.folder / "b") + "\0b.exr"), lambda: duet.compare(cut, image),
                     lambda: duet.load_file(str(self.file) + "\0"), lambda: duet.merge([cut]),
                     lambda: duet.load_file(self.file, search_paths=["a\0b"])]:
            with self.assertRaisesRegex(ValueError, "a path cannot go on with a zero byte"):
                call()
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["a.exr", "scene.xml"])

    def test_of_comparisons(self):
        image = numpy.ones((16, 24, 3))
        variance = numpy.full((16, 24), 1e-3)
        for spp in [-1, 0, float("nan"), float("inf")]:
            with self.subTest(spp=spp), self.assertRaisesRegex(ValueError, "image_spp"):
                duet.compare(image, image, variance=variance, image_spp=spp, reference_spp=1)
            with self.subTest(spp=spp), self.assertRaisesRegex(ValueError, "reference_spp"):
                duet.compare(image, image, variance=variance, image_spp=1, reference_spp=spp)
        with self.assertRaisesRegex(TypeError, "image_spp"):
            duet.compare(image, image, variance=variance, image_spp="a", reference_spp=1)
        with self.assertRaisesRegex(ValueError, "the variance is negative"):
            duet.compare(image, image, variance=-variance, image_spp=1, reference_spp=1)
        # What rounding makes of a difference of moments is a variance.
        variance[3, 4] = -1e-6
        self.assertIn("bias_test", duet.compare(image, image, variance=variance, image_spp=1, reference_spp=1))

    def test_of_welch(self):
        for wrong in [([1, 2, float("nan")], 1), ([1, 2], float("inf")), ([1, 2], 1, -5), ([1, 2], 1, float("nan"))]:
            with self.subTest(wrong), self.assertRaises(ValueError):
                duet.welch(*wrong)
        for wrong in [(["1", "2"], 1), ([1, 2], None)]:
            with self.subTest(wrong), self.assertRaises(TypeError):
                duet.welch(*wrong)

    def test_the_number_of_threads_of_the_environment(self):
        code = "import duet, numpy; a = numpy.ones((4, 4, 3)); duet.compare(a, a)"
        done = subprocess.run([sys.executable, "-c", code], env={**os.environ, "DUET_THREADS": "abc"}, text=True,
                              capture_output=True, check=False)
        self.assertIn('ValueError: DUET_THREADS: "abc" is not a whole number', done.stderr)


class Dictionaries(DuetTest):
    def load(self, entry, name="a"):
        return duet.load_dict({**BASE, name: entry})

    def test_what_is_no_value_is_named_by_its_keys(self):
        itself = {"type": "sphere"}
        itself["x"] = {"type": "twosided", "y": itself}
        light = {"type": "point"}
        wrong = {
            "a": [None, b"text", 1j, [{"type": "sphere"}], {"type": 3}],
            "a.radius": [{"type": "sphere", "radius": v} for v in (None, b"1", 1j, {1}, object())],
            "a.to_world": [{"type": "sphere", "to_world": v} for v in (numpy.eye(4) * (1 + 1j), numpy.full((4, 4), "a"))],
            "a.center": [{"type": "sphere", "center": v} for v in (b"123", [1, [2], 3], ["1", "2", "3"])],
            "a.intensity": [{**light, "intensity": {"type": "rgb", "value": v}} for v in (None, b"1", [object()] * 3, True)],
            "a.id": [{"type": "sphere", "id": 5}], "a.bsdf.id": [{"type": "sphere", "bsdf": {"type": "ref", "id": 5}}]}
        for place, entries in wrong.items():
            for entry in entries:
                with self.subTest(entry), self.assertRaisesRegex(TypeError, f"^{place}(:|\\.type| is)"):
                    self.load(entry)
        values = {
            "a.radius": [{"type": "sphere", "radius": HUGE}],
            "a.center": [{"type": "sphere", "center": numpy.ones((3, 3))}],
            "a.intensity": [{**light, "intensity": {"type": "rgb", "value": [1, 2, 3], "foo": 3}},
                            {**light, "intensity": {"type": "rgb", "value": HUGE}},
                            {**light, "intensity": {"type": "rgb", "value": [[1, 2, 3]]}}],
            "a.x.y": [itself], "a.bsdf": [{"type": "sphere", "bsdf": {"type": "ref"}}],
            "a.filename": [{"type": "obj", "filename": "\ud800"}]}
        for place, entries in values.items():
            for entry in entries:
                with self.subTest(place), self.assertRaisesRegex(ValueError, f"^{place}:"):
                    self.load(entry)
        with self.assertRaisesRegex(ValueError, '"rgb" has no \'foo\''):
            self.load(values["a.intensity"][0])

    def test_keys(self):
        with self.assertRaisesRegex(TypeError, "^the scene: the keys of a dict are str, not int: 3"):
            self.load({"type": "sphere"}, 3)
        with self.assertRaisesRegex(TypeError, "^a: the keys of a dict are str, not int: 3"):
            self.load({"type": "sphere", 3: 1.0})
        with self.assertRaisesRegex(ValueError, "^the scene: a key: .*surrogate"):
            self.load({"type": "sphere"}, "a\ud800b")

    def test_numbers_of_numpy(self):
        for radius in [numpy.array(2.0), numpy.array(2), numpy.float32(2), numpy.int64(2)]:
            scene = self.load({"type": "sphere", "radius": radius, "flip_normals": numpy.array(True)})
            self.assertIn("sphere", str(scene))
        for value in [numpy.array(0.5), numpy.full(3, 0.5, numpy.float16)]:
            self.load({"type": "point", "intensity": {"type": "rgb", "value": value}})

    def test_one_dict_may_stand_in_two_places(self):
        white = {"type": "diffuse"}
        duet.load_dict({**BASE, "a": {"type": "sphere", "bsdf": white}, "b": {"type": "sphere", "bsdf": white}})

    def test_transforms_are_not_complex(self):
        with self.assertRaisesRegex(TypeError, "complex"):
            duet.Transform4f(numpy.eye(4) * 1j)


if __name__ == "__main__":
    unittest.main()
