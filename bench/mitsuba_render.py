#!/usr/bin/env python3
"""Renders a scene with the integrator of its file by a variant of Mitsuba.

    mitsuba_render.py [--further] VARIANT SCENE OUT SPP SEED WIDTH HEIGHT THREADS

--further prints the CPU seconds of the image alone: the same with another seed is rendered before, which compiles the
kernels and starts the threads. What is left is what one more image takes.
"""
import resource
import sys

import mitsuba as mi
import numpy as np


def cpu_seconds():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


def main():
    further = sys.argv[1] == '--further'
    variant, scene_file, out = sys.argv[1 + further:4 + further]
    spp, seed, width, height, threads = map(int, sys.argv[4 + further:])
    mi.set_variant(variant)
    mi.set_log_level(mi.LogLevel.Error)
    import drjit as dr  # after the variant, which loads LLVM
    # With one thread, to read or write an image would wait for ever.
    scene = mi.load_file(scene_file)
    dr.set_thread_count(threads)
    parameters = mi.traverse(scene.sensors()[0])
    parameters['film.size'] = mi.ScalarVector2u(width, height)
    parameters.update()
    if further:
        np.array(mi.render(scene, spp=spp, seed=seed + 1_000_000))
    start = cpu_seconds()
    # The array waits for the image.
    image = np.array(mi.render(scene, spp=spp, seed=seed))
    if further:
        print(cpu_seconds() - start)
    dr.set_thread_count(max(2, threads))
    mi.Bitmap(image).write(out)


if __name__ == '__main__':
    main()
