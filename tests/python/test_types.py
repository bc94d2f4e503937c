"""What editors and type checkers see of the Python package: docstrings, annotations and the stubs of duet._duet."""
import ast
import importlib.util
import inspect
import pathlib
import site
import subprocess
import sys
import tempfile
import unittest

import duet
from duet import _duet

PACKAGE = pathlib.Path(duet.__file__).parent
STUBS = PACKAGE / "_duet.pyi"

USER = """
import duet
import numpy

scene = duet.load_file("room.xml", spp=64)
image = duet.render(scene, spp=4, size=(64, 64), aovs=["depth"], progress=lambda fraction, spp, seconds: None)
height: int = image.shape[0]
pixels: numpy.ndarray = numpy.asarray(image)
matrix = duet.Transform4f.translate([0, 1, 0]).rotate([0, 1, 0], 30).inverse().matrix
figures: dict[str, object] = duet.compare(image, pixels, variance="variance.exr", image_spp=4, reference_spp=16)
z: float = duet.welch([1.0, 2.0], expected=1.5).z
image.save("room.png", exposure="auto")
duet.util.write_bitmap("room.exr", duet.merge(["1.exr", "2.exr"]))
"""

MISTAKES = """
import duet

duet.render("room.xml")
duet.render(duet.load_string(""), spp="4")
duet.Transform4f.rotate([0, 1, 0])
duet.load_file("room.xml").shape
"""


def public_functions():
    """All that has a signature and can be called by users, with its name."""
    for name in duet.__all__:
        value = getattr(duet, name)
        if inspect.isfunction(value):
            yield name, value
        elif inspect.isclass(value):
            for inner, member in vars(value).items():
                if isinstance(member, property):
                    member = member.fget
                elif isinstance(member, classmethod):
                    member = member.__func__
                if not inner.startswith("_") and callable(member):
                    yield f"{name}.{inner}", member
    yield "util.write_bitmap", duet.util.write_bitmap


class Annotations(unittest.TestCase):
    def test_everything_public_has_a_docstring(self):
        for name in set(duet.__all__) - {"__version__"}:
            self.assertTrue(inspect.getdoc(getattr(duet, name)), name)
        for name, function in public_functions():
            self.assertTrue(inspect.getdoc(function), name)
        for step in ["translate", "scale", "rotate", "look_at"]:
            self.assertTrue(getattr(duet.Transform4f, step).__doc__, step)

    def test_everything_public_has_types(self):
        names = dict(public_functions())
        self.assertLessEqual({"render", "compare", "load_dict", "Image.save", "Image.from_array", "Scene.info"}, set(names))
        for name, function in names.items():
            signature = inspect.signature(function)
            self.assertIsNot(signature.return_annotation, signature.empty, name)
            for parameter in list(signature.parameters.values()):
                if parameter.name not in ("self", "cls"):
                    self.assertIsNot(parameter.annotation, parameter.empty, f"{name}: {parameter.name}")


@unittest.skipUnless(STUBS.exists(), "a build with sanitizers has no stubs")
class Stubs(unittest.TestCase):
    def test_they_name_all_that_the_module_has(self):
        def names(body):
            return {n.name for n in body if isinstance(n, (ast.FunctionDef, ast.ClassDef))} | {
                n.target.id for n in body if isinstance(n, ast.AnnAssign)}

        def public(value):
            return {n for n in vars(value) if not n.startswith("_")}
        tree = ast.parse(STUBS.read_text(encoding="utf-8"))
        self.assertEqual(public(_duet), names(tree.body))
        for node in tree.body:
            if isinstance(node, ast.ClassDef):
                with self.subTest(node.name):
                    self.assertEqual(public(getattr(_duet, node.name)),
                                     {n for n in names(node.body) if not n.startswith("_")})

    def check(self, *arguments, text=None):
        """What mypy writes, by its strictest rules."""
        if importlib.util.find_spec("mypy") is None:
            self.skipTest("mypy is not installed")
        with tempfile.TemporaryDirectory() as folder:
            if text is not None:
                file = pathlib.Path(folder) / "user.py"
                file.write_text(text, encoding="utf-8")
                arguments = [*arguments, str(file)]
            # mypy finds by itself what is installed, and refuses to be told of it.
            installed = str(PACKAGE.parent) in site.getsitepackages()
            done = subprocess.run(
                [sys.executable, "-m", "mypy", "--strict", "--no-error-summary", "--cache-dir", folder, *arguments],
                capture_output=True, text=True, env={} if installed else {"MYPYPATH": str(PACKAGE.parent)}, cwd=folder,
                check=False)
        self.assertEqual(done.stderr, "")
        self.assertEqual(done.returncode, 1 if done.stdout else 0)
        return done.stdout

    def test_mypy_of_the_package(self):
        self.assertEqual(self.check("-p", "duet"), "")

    def test_mypy_of_a_program(self):
        self.assertEqual(self.check(text=USER), "")
        found = self.check(text=MISTAKES)
        for line in range(4, 8):
            self.assertIn(f"user.py:{line}: error", found)
