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

from planted_bugs import MUTATIONS

ROOT = pathlib.Path(__file__).resolve().parent.parent


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
    result = run(["cmake", "--build", str(work / "build"), "--target", "duet", "duet_tests"])
    if result.returncode != 0:
        raise SystemExit(result.stdout[-3000:])


def fails(work, test):
    return run([str(work / "build" / "duet_tests"), f"--test-case={test}",
                "--test-suite-exclude=agreement,references"]).returncode != 0


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
