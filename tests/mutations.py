#!/usr/bin/env python3
"""Plants bugs into a copy of the sources, one at a time, and checks that the named test fails for each.

    tests/mutations.py [NAME...]      all of them, or those named; --list prints them
    tests/mutations.py --markdown     the table of docs/mutations.md
    tests/mutations.py --check        whether that page has this table, and every place is there; builds nothing

Builds in a temporary folder (--work FOLDER keeps it for the next run), --jobs N bugs at once (as many as there are
processors), with ccache if it is installed. Exits with 1 if a bug goes unnoticed, or if a place to plant it is gone.
"""
import argparse
import concurrent.futures
import os
import pathlib
import queue
import shutil
import subprocess
import sys
import tempfile

from planted_bugs import MUTATIONS

ROOT = pathlib.Path(__file__).resolve().parent.parent
# No test takes as long, but one that a bug lets run forever.
SECONDS = 1200


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


class Tree:
    """A copy of the sources and a build of it, for one bug at a time."""

    def __init__(self, folder):
        self.folder = folder
        for name in ["src", "parsers", "tests", "scenes", "reference", "scripts", "CMakeLists.txt"]:
            update(ROOT / name, folder / name)
        # Bugs are mostly in one file of the library: it is compiled alone. Tests are compiled several at once.
        command = ["cmake", "-S", str(folder), "-B", str(folder / "build"), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=None",
                   "-DCMAKE_UNITY_BUILD_BATCH_SIZE=1", "-DCMAKE_CXX_FLAGS=-O1 -DNDEBUG -w -DDUET_ONE_INSTRUCTION_SET"]
        self.environment = dict(os.environ)
        if shutil.which("ccache"):
            # What a bug had changed comes back from the cache, and so does what another copy has compiled.
            command.append("-DCMAKE_CXX_COMPILER_LAUNCHER=ccache")
            self.environment |= {"CCACHE_BASEDIR": str(folder), "CCACHE_NOHASHDIR": "1", "CCACHE_SLOPPINESS":
                                 "pch_defines,time_macros,include_file_mtime,include_file_ctime"}
        result = run(command, env=self.environment)
        if result.returncode != 0:
            raise SystemExit(result.stdout[-3000:])

    def build(self, jobs):
        result = run(["cmake", "--build", str(self.folder / "build"), "-j", str(jobs), "--target", "duet", "duet_tests"],
                     env=self.environment)
        if result.returncode != 0:
            raise SystemExit(result.stdout[-3000:])

    def fails(self, test):
        try:
            return run([str(self.folder / "build" / "duet_tests"), f"--test-case={test}",
                        "--test-suite-exclude=agreement,references"], timeout=SECONDS).returncode != 0
        except subprocess.TimeoutExpired:
            return True

    def notices(self, mutation):
        """Whether the test of a bug fails with the bug in its place."""
        _, file, there, bug, test = mutation
        path = self.folder / file
        text = path.read_text()
        path.write_text(text.replace(there, bug))
        self.build(1)
        noticed = self.fails(test)
        path.write_text(text)
        return noticed


def markdown():
    rows = [f"| {name} (`{file}`) | {test} |" for name, file, _, _, test in MUTATIONS]
    return "\n".join(["| bug | has to be noticed by |", "|---|---|", *rows]) + "\n"


def gone(mutations):
    """What to say of those bugs of which the place is not there, or not once."""
    return [f"{name}: the place in {file} is gone" for name, file, there, _, _ in mutations
            if (ROOT / file).read_text().count(there) != 1]


def check():
    """Prints what is stale, here or in docs/mutations.md; returns whether nothing is."""
    stale = gone(MUTATIONS)
    page = (ROOT / "docs" / "mutations.md").read_text()
    if f"\n\n{markdown()}\n" not in page:
        stale.append("the table of docs/mutations.md is not what --markdown prints")
    print("\n".join(stale) or "nothing is stale")
    return not stale


def unnoticed(trees, mutations):
    """Plants every bug, as many at once as there are trees, and returns how many are not noticed."""
    free = queue.SimpleQueue()
    for tree in trees:
        free.put(tree)

    def in_a_tree(work, *arguments):
        tree = free.get()
        try:
            return work(tree, *arguments)
        finally:
            free.put(tree)

    def report(mutation):
        noticed = in_a_tree(Tree.notices, mutation)
        print(f"{mutation[0]}: {'caught by' if noticed else 'NOT CAUGHT by'} \"{mutation[4]}\"", flush=True)
        return noticed

    with concurrent.futures.ThreadPoolExecutor(len(trees)) as pool:
        tests = sorted({m[4] for m in mutations})
        broken = [test for test, fails in zip(tests, pool.map(lambda t: in_a_tree(Tree.fails, t), tests)) if fails]
        if broken:
            raise SystemExit("\n".join(f"\"{test}\" fails without any bug" for test in broken))
        return sum(not noticed for noticed in pool.map(report, mutations))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--markdown", action="store_true")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--work", type=pathlib.Path)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
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
    unknown = set(options.names) - {m[0] for m in MUTATIONS}
    if unknown:
        parser.error(f"there is no bug \"{sorted(unknown)[0]}\"; --list prints them")
    mutations = [m for m in MUTATIONS if not options.names or m[0] in options.names]
    if gone(mutations):
        raise SystemExit("\n".join(gone(mutations)))
    work = options.work or pathlib.Path(tempfile.mkdtemp(prefix="duet-mutations-"))
    trees = []
    for number in range(max(1, min(options.jobs, len(mutations)))):
        trees.append(Tree(work.resolve() / str(number)))
        trees[-1].build(options.jobs)
    missed = unnoticed(trees, mutations)
    if not options.work:
        shutil.rmtree(work)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
