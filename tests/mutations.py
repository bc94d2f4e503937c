#!/usr/bin/env python3
"""Plants bugs into a copy of the sources, one at a time, and checks that the named test fails for each.

    tests/mutations.py [NAME...]      all of them, or those named; --list prints them
    tests/mutations.py --markdown     the table of docs/mutations.md
    tests/mutations.py --check        whether that page has this table, and every place is there; builds nothing

Builds in a temporary folder (--work FOLDER keeps it for the next run). Exits with 1 if a bug goes unnoticed, or if a
place to plant it is gone.
"""
import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
WEIGHTS = "weights of*"
SUMS = "running sums*"
MEAN = "unbiased methods have the same mean"

# name, file, what stands there, the bug, the test that must fail
MUTATIONS = [
    ("cosine dropped from the sums", "src/transport/walk.h",
     "const float cosine_out = v.cosine(s->wi);", "const float cosine_out = 1;", WEIGHTS),
    ("squared index dropped at refraction", "src/transport/walk.h",
     "in / (out * s->eta * s->eta)", "in / out", WEIGHTS),
    ("probability of the light dropped from emission", "src/transport/light_walk.h",
     "e->weight * (1 / pick.probability)", "e->weight", MEAN),
    ("probability of the light dropped from light samples", "src/transport/join.h",
     "sample->weight * (1 / pick.probability)", "sample->weight", MEAN),
    ("T off by one", "src/transport/window_weights.h",
     "if (t <= eye + 1 && s <= light + 1)", "if (t <= eye && s <= light + 1)", WEIGHTS),
    ("S off by one", "src/transport/window_weights.h",
     "if (t <= eye + 1 && s <= light + 1)", "if (t <= eye + 1 && s <= light)", WEIGHTS),
    ("number of light walks dropped from the weight of splats", "src/transport/weights.h",
     "camera_scale_(set.connection_share / set.light_paths)", "camera_scale_(set.connection_share)",
     SUMS),
    ("number of light walks dropped from splats", "src/integrators/bidirectional.cpp",
     "const float scale = 1 / set_.light_paths;", "const float scale = 1;", MEAN),
    ("adjoint of shading normals dropped", "src/transport/path_vertex.h",
     "if (shading == geometric) return 1;", "return 1;", MEAN),
    ("photons count twice", "src/integrators/bidirectional_eye.cpp",
     "const float kernel = eye.photon_share", "const float kernel = 2 * eye.photon_share", "merging hardly*"),
    ("merges dropped from the sum of the eye", "src/transport/mis.h",
     "eye.vcm * connection_term + eye_reverse * eye.vm", "eye.vcm * connection_term", SUMS),
    ("connections see through walls", "src/transport/join.h",
     "if (scene.accel->occluded(spawn_ray_to(eye.surface, target)))", "if (d2 < 0)", MEAN),
    ("reverse densities per solid angle taken for areas", "src/transport/walk.h",
     "reverse * trail.back().back", "reverse", WEIGHTS),
    ("the tail's roulette is not made up for", "src/integrators/bidirectional_eye.cpp",
     "walk.throughput *= 1 / q;", "", MEAN),
    ("splats are not divided by the number of passes", "src/image/film.cpp",
     "sum / (filter * passes_)", "sum / filter", MEAN),
    ("the filter is not cut off at the border for splats", "src/image/film.cpp",
     "std::max(center - r, double(lower))", "center - r", "splats are as bright*"),
    ("cached connections forget how many there are", "src/integrators/bidirectional_eye.cpp",
     "double(set_.light_paths) * options_.connections", "double(set_.light_paths)", MEAN),
    ("a light sample taken for less likely behind a medium", "src/media/homogeneous.cpp",
     "w.light *= chosen > 0 ? std::exp(chosen * ray.tmax) : 1.0f;", "", "light gets as far in a homogeneous*"),
    ("channels weighed as if all were chosen alike", "src/media/homogeneous.cpp",
     "w.walk *= density;\n  w.value *= density;", "w.value *= density;", "light gets as far in a homogeneous*"),
    ("null collisions forgotten in the weights", "src/media/heterogeneous.cpp",
     "w.light *= majorant / missed;", "", "light gets as far in a grid*"),
    ("the roulette of shadow rays is not made up for", "src/media/heterogeneous.cpp",
     "w.value *= kFaint / most;", "", "light gets as far in a grid*"),
    ("surfaces do not change the medium", "src/integrators/volpath.cpp",
     "if (separates) path.medium = scene.medium_beyond(s, sample->wi);", "", "a slab that only absorbs*"),
    ("what passes straight through lengthens the path", "src/integrators/volpath.cpp",
     "if (!sample->null) {", "{", "a slab that only absorbs*"),
    ("shadow rays pass masks whole", "src/transport/shadow_walk.h",
     "w.value *= bsdf.straight_through();", "", "light samples and scattering find*"),
    ("light scattered backwards goes straight on", "src/media/phase_functions.cpp",
     "return -dot(wo, wi);", "return dot(wo, wi);", "phase functions have Mitsuba's*"),
    ("nodes of grids shifted by half a cell", "src/media/volume.cpp",
     "x * n - 0.5f", "x * n", "grids of Mitsuba 3*"),
    ("vertices in media count like those on surfaces", "src/transport/media_vertex.h",
     "return in_medium ? extinction : PathVertex::cosine(w);", "return in_medium ? 1.0f : PathVertex::cosine(w);",
     "weights in media*"),
    ("weights without the transmittance of connections", "src/transport/join.h",
     "light_end.arrival *= passage->nominal, eye_end.arrival *= passage->nominal;", "", "weights in media*"),
    ("connections pass media unweakened", "src/transport/join.h",
     "join.value *= passage->value;\n    light_end.arrival *= passage->nominal;", "", "walks from both ends*"),
    ("lights stand in no medium", "src/scene/light_media.cpp",
     "first = {s.position, scene.medium_beyond(s, -w)};", "first = {s.position, nullptr};",
     "unbiased methods have the same mean in media"),
    ("one point of a light tells the medium of all", "src/scene/light_media.cpp",
     "return {nullptr, true, point_of(*boundary)};", "(void)boundary;", "unbiased methods have the same mean in media"),
    ("where nothing is merged light is weighed as if it were", "src/transport/weights.h",
     "return unmerged_ ? p.vm : p.vc;", "return p.vc;", "weights are the balance heuristic in pixels*"),
    ("photons are merged in all pixels", "src/integrators/bidirectional_eye.cpp",
     "if (eye.merging && v.merges()) merge(weights, v, eye);", "if (set_.merges && v.merges()) merge(weights, v, eye);",
     "where vcm merges*"),
    ("tiles get samples by their own noise", "src/integrators/sample_allocation.cpp",
     "rates_[0] = tile_rates(films_.subspan(half));", "rates_[0] = tile_rates(films_.first(half));",
     "a film's samples have no say*"),
    ("films weigh as much as they have samples", "src/image/film.cpp",
     "const double scale = sample_scale(total / filled, samples(f));", "const double scale = 1;", "each film counts the same*"),
    ("the scene stands still", "src/integrators/integrator.cpp",
     "scene.motion->pose(time_of_sample(samples, one.first));", "", "posing a scene*"),
    ("the first number of a pixel goes with the time", "src/integrators/motion_blur.cpp",
     "sampler.start_dimension(kSobolDimensions);", "", "times are even*"),
    ("lights stay where their shapes were", "src/scene/place.cpp",
     "scene_->lights[k] = make(emissions_[k], shape);", "return;", "posing a scene*"),
    ("rotations take the longer way", "src/math/motion.cpp", "if (cosine < 0) {", "if (cosine > 0) {",
     "rotations take the shorter way"),
    ("flakes are not mirrors", "src/media/sggx.cpp",
     "4 * kPi * m.determinant()", "kPi * m.determinant()", "phase functions send light*"),
]


def run(command, **more):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **more)


def update(source, copy):
    """Makes `copy` equal to `source`. What is equal keeps its time: it tells the build what a bug had changed."""
    if source.is_dir():
        copy.mkdir(parents=True, exist_ok=True)
        for old in copy.iterdir():
            if not (source / old.name).exists():
                shutil.rmtree(old) if old.is_dir() else old.unlink()
        for part in source.iterdir():
            update(part, copy / part.name)
    elif not copy.exists() or copy.read_bytes() != source.read_bytes():
        shutil.copyfile(source, copy)


def build(work):
    result = run(["cmake", "--build", str(work / "build"), "--target", "duet_tests"])
    if result.returncode != 0:
        raise SystemExit(result.stdout[-3000:])


def fails(work, test):
    return run([str(work / "build" / "duet_tests"), f"--test-case={test}",
                "--test-suite-exclude=agreement,references,program"]).returncode != 0


def markdown():
    rows = [f"| {name} (`{file}`) | {test} |" for name, file, _, _, test in MUTATIONS]
    return "\n".join(["| bug | has to be noticed by |", "|---|---|", *rows]) + "\n"


def check():
    """Prints what is stale, here or in docs/mutations.md; returns whether nothing is."""
    stale = [f"{name}: the place in {file} is gone" for name, file, there, _, _ in MUTATIONS
             if (ROOT / file).read_text().count(there) != 1]
    page = (ROOT / "docs" / "mutations.md").read_text()
    if f"\n\n{markdown()}\n" not in page:
        stale.append("the table of docs/mutations.md is not what --markdown prints")
    print("\n".join(stale) or "nothing is stale")
    return not stale


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--markdown", action="store_true")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--work", type=pathlib.Path)
    options = parser.parse_args()
    if options.list:
        for name, file, _, _, test in MUTATIONS:
            print(f"{name} ({file}): \"{test}\"")
        return 0
    if options.markdown:
        print(markdown(), end="")
        return 0
    if options.check:
        return 0 if check() else 1
    work = options.work or pathlib.Path(tempfile.mkdtemp(prefix="duet-mutations-"))
    for name in ["src", "parsers", "tests", "scenes", "reference", "CMakeLists.txt"]:
        update(ROOT / name, work / name)
    run(["cmake", "-S", str(work), "-B", str(work / "build"), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=None",
         "-DCMAKE_CXX_FLAGS=-O1 -DNDEBUG -w"])
    build(work)
    for test in {m[4] for m in MUTATIONS}:
        if fails(work, test):
            print(f"\"{test}\" fails without any bug")
            return 1
    unnoticed = 0
    for name, file, there, bug, test in MUTATIONS:
        if options.names and name not in options.names:
            continue
        path = work / file
        text = path.read_text()
        if text.count(there) != 1:
            print(f"{name}: the place in {file} is gone")
            unnoticed += 1
            continue
        path.write_text(text.replace(there, bug))
        build(work)
        caught = fails(work, test)
        path.write_text(text)
        print(f"{name}: {'caught by' if caught else 'NOT CAUGHT by'} \"{test}\"", flush=True)
        unnoticed += not caught
    if not options.work:
        shutil.rmtree(work)
    return 1 if unnoticed else 0


if __name__ == "__main__":
    sys.exit(main())
