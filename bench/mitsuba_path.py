#!/usr/bin/env python3
"""Renders a scene with the integrator of its file by Mitsuba's llvm_ad_rgb, and prints the CPU seconds of that alone.

    mitsuba_path.py SCENE OUT WIDTH HEIGHT SPP SEED THREADS

Start-up is not in them: the same image with another seed is rendered before, which loads the scene, compiles the kernels
and starts the threads. What is left is what one more image takes.
"""
import resource
import sys

import mitsuba as mi
import numpy as np


def cpu_seconds():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


def main():
    scene_file, out = sys.argv[1:3]
    width, height, spp, seed, threads = map(int, sys.argv[3:])
    mi.set_variant('llvm_ad_rgb')
    mi.set_log_level(mi.LogLevel.Error)
    import drjit as dr  # after the variant, which loads LLVM
    # With one thread, to read or write an image would wait for ever.
    scene = mi.load_file(scene_file)
    dr.set_thread_count(threads)
    parameters = mi.traverse(scene.sensors()[0])
    parameters['film.size'] = mi.ScalarVector2u(width, height)
    parameters.update()
    np.array(mi.render(scene, spp=spp, seed=seed + 1_000_000))
    start = cpu_seconds()
    image = np.array(mi.render(scene, spp=spp, seed=seed))
    print(cpu_seconds() - start)
    dr.set_thread_count(max(2, threads))
    mi.Bitmap(image).write(out)


if __name__ == '__main__':
    main()
