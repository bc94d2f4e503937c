"""Renders beside what else goes on in a process: other threads, the end of the interpreter, forks, watchers."""
import os
import subprocess
import sys
import threading
import time
import unittest

import duet
import numpy
from duet import _duet

from support import SCENE, DuetTest

#: It has many samples in a second.
ENDLESS = 2**30

START = """
import os, sys, threading, time
import duet
import numpy
scene = duet.load_file("scene.xml")

def in_background(work):
    thread = threading.Thread(target=work, daemon=True)
    thread.start()
    time.sleep(0.5)
"""


class Ending(DuetTest):
    def run_process(self, code):
        """Runs code in a process of its own, in the folder of the scene, and returns what it prints."""
        done = subprocess.run([sys.executable, "-W", "ignore", "-c", START + code], cwd=self.folder, text=True,
                              capture_output=True, timeout=120, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def test_the_interpreter_ends_while_a_daemon_thread_renders(self):
        for options in ["", ", progress=lambda *_: time.sleep(0.01)", ", size=(2000, 2000)"]:
            with self.subTest(options):
                self.assertEqual(self.run_process(f"""
in_background(lambda: duet.render(scene, spp={ENDLESS}{options}))
print("end")
"""), "end\n")

    def test_the_interpreter_ends_while_daemon_threads_call_one_function_after_another(self):
        self.run_process("""
image = duet.render(scene, spp=1, size=(200, 200))
def always(work):
    def repeat():
        while True:
            work()
    return repeat
for work in [lambda: duet.render(scene, spp=1), lambda: duet.compare(image, image), lambda: image._repr_png_(),
             lambda: duet.load_file("scene.xml"), lambda: scene.info()]:
    in_background(always(work))
""")

    def test_functions_that_are_called_at_the_end_can_render(self):
        # They are called in the reverse order in which they are registered.
        self.assertEqual(self.run_process(f"""
import atexit
in_background(lambda: duet.render(scene, spp={ENDLESS}))
atexit._clear()
atexit.register(lambda: print(duet.render(scene, spp=2).metadata["spp"]))
atexit.register(duet._end_calls)
"""), "2\n")

    @unittest.skipUnless(hasattr(os, "fork"), "the system has no fork")
    def test_a_process_is_forked_while_another_thread_renders(self):
        printed = self.run_process(f"""
image = duet.render(scene, spp=4)
in_background(lambda: duet.render(scene, spp={ENDLESS}))
child = os.fork()
if child == 0:
    again = duet.render(scene, spp=4)
    print(int((numpy.asarray(again) == numpy.asarray(image)).all()), duet.compare(again, image)["rmse"])
    again.save("child.png")
    duet.load_file("scene.xml")
    sys.exit()
print(os.waitpid(child, 0)[1])
""")
        self.assertEqual(printed, "1 0.0\n0\n")
        self.assertTrue((self.folder / "child.png").exists())


class Progress(DuetTest):
    def test_short_renders_tell_their_end(self):
        calls = []
        duet.render(duet.load_string(SCENE), spp=3, progress=lambda *share: calls.append(share))
        self.assertEqual(calls[-1][:2], (1, 3))
        self.assertGreater(calls[-1][2], 0)

    def test_interrupted_renders_tell_how_far_they_are(self):
        calls = []

        def stop(*share):
            calls.append(share)
            if share[1] >= 1:
                raise KeyboardInterrupt
        self.assertTrue(duet.render(duet.load_string(SCENE), spp=ENDLESS, progress=stop).interrupted)
        self.assertLess(calls[-1][0], 1)

    def test_functions_that_cannot_be_called_are_refused_before(self):
        scene = duet.load_string(SCENE)
        for wrong in [lambda: None, lambda fraction: None, lambda a, b, c, d: None]:
            with self.assertRaisesRegex(TypeError, "progress is called with 3 arguments"):
                duet.render(scene, spp=ENDLESS, progress=wrong)
        for right in [lambda a, b=0, *c: None, None, False, numpy.bool_(False)]:
            duet.render(scene, spp=1, progress=right)


class OtherThreads(DuetTest):
    def assert_they_run(self, call):
        """That another thread runs within a call, without which none can here."""
        turn, ran = threading.Lock(), threading.Event()

        def wait():
            with turn:
                ran.set()
        turn.acquire()
        other = threading.Thread(target=wait)
        other.start()
        before = sys.getswitchinterval()
        sys.setswitchinterval(1000)
        try:
            turn.release()
            end = time.monotonic() + 20
            while not ran.is_set() and time.monotonic() < end:
                call()
            self.assertTrue(ran.is_set())
        finally:
            sys.setswitchinterval(before)
            other.join()

    def test_during_each_call_that_takes_a_while(self):
        scene = duet.load_file(self.file)
        image = duet.Image.from_array(numpy.full((300, 300, 3), 0.5))
        image.save(self.folder / "a.exr")
        file, pixels = str(self.folder / "a.exr"), numpy.asarray(image)
        calls = {"png": image._pixels.png, "from_rgba": lambda: _duet.Image.from_rgba(pixels),
                 "load": lambda: _duet.ComparedImage.load(file),
                 "from_pixels": lambda: _duet.ComparedImage.from_pixels(pixels, image.channels),
                 "from_image": lambda: _duet.ComparedImage.from_image(image._pixels), "json": scene._read.json,
                 "summary": scene._read.summary}
        for name, call in calls.items():
            with self.subTest(name):
                self.assert_they_run(call)


if __name__ == "__main__":
    unittest.main()
