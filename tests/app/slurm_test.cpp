// duet slurm: what it submits, and what it refuses. tests/slurm_test.py has real daemons.
#include <doctest/doctest.h>

#include <filesystem>

#include "app/workplace.h"
#include "base/system/run_program.h"
#include "image/image_io.h"
#include "support/source_path.h"

using namespace duet;
using namespace duet::test;

namespace {

namespace fs = std::filesystem;

/// A place with a scene, whose sums show in the image, and with a PATH of its own.
class Cluster : public Workplace {
 public:
  Cluster() {
    scene("room.xml", exact_scene());
    fs::create_directory(path("bin"));
  }
  /// Makes this the program `sbatch`.
  void sbatch(const std::string& script) const {
    const std::string file = write("bin/sbatch", "#!/bin/sh\n" + script);
    fs::permissions(file, fs::perms::owner_all);
  }
  Outcome submit(const std::vector<std::string>& arguments, bool only_bin = false) const {
    std::vector<std::string> all{"slurm"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const std::string bin = path("bin");
    return run_duet(all, {.directory = path(""),
                          .environment = {{"PATH", only_bin ? bin : bin + ":/usr/bin:/bin"}}});
  }
  ProgramEnd shell(const std::string& command) const {
    return run_program({"env", "-C", path(""), "bash", "-c", command});
  }
  Image image(const std::string& name) const { return read_image(path(name)).image; }
};

/// A script as a block of code in a page.
std::string indented(const std::string& script) {
  std::string text = "    ";
  for (size_t i = 0; i + 1 < script.size(); ++i)
    text += script[i] == '\n' ? "\n    " : std::string(1, script[i]);
  return text + "\n\n";
}

/// Runs at once what is submitted, but for the task $LOST.
const char* const kAtOnce = R"sh(echo "$@" >> calls
for script; do :; done
tasks=$(sed -n 's/^#SBATCH --array=1-//p' "$script")
if [ -z "$tasks" ]; then bash "$script" > merge.log 2>&1; echo 8; exit; fi
export SLURM_CPUS_ON_NODE=1 SLURM_ARRAY_TASK_ID
for SLURM_ARRAY_TASK_ID in $(seq "$tasks"); do
  [ "$SLURM_ARRAY_TASK_ID" = "$(cat lost)" ] || bash "$script" >> log 2>&1
done
echo '7;east'
)sh";

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("slurm: a lost slice is named with the command that renders it") {
    const Cluster place;
    place.sbatch(kAtOnce);
    place.write("lost", "3");
    const Outcome o = place.submit(
        {"room.xml", "--tasks", "3", "-o", "out/it's.exr", "-o", "b.png", "--", "--spp", "10"});
    REQUIRE_MESSAGE(o.code == 0, o.err);
    CHECK(contains(o.err, "3 tasks are job 7"));
    CHECK(contains(o.err, "merge is job 8"));
    CHECK(read_file(place.path("calls")) ==
          "--parsable out/it's.slurm/render.sh\n"
          "--parsable --dependency=afterany:7 --clusters=east out/it's.slurm/merge.sh\n");
    const std::string log = read_file(place.path("merge.log"));
    CAPTURE(log);
    const std::string begin = "error: slice 3/3 lacks the samples 6:10; render them with: ";
    REQUIRE(contains(log, begin));
    CHECK(!contains(log, "slice 1/3"));
    CHECK(contains(log, "samples are missing: 6:10"));
    CHECK(place.has("b.png"));

    REQUIRE(place.run({"room.xml", "--spp", "10", "-o", "whole.exr", "-q"}).code == 0);
    CHECK(place.image("out/it's.exr").data != place.image("whole.exr").data);
    const size_t at = log.find(begin) + begin.size();
    REQUIRE(place.shell(log.substr(at, log.find('\n', at) - at)).exit_code == 0);
    const ProgramEnd again = place.shell("bash \"out/it's.slurm/merge.sh\"");
    CHECK_MESSAGE(again.exit_code == 0, again.err);
    CHECK(place.image("out/it's.exr").data == place.image("whole.exr").data);
  }

  TEST_CASE("slurm: the same command again renders what is lost") {
    const Cluster place;
    place.sbatch(kAtOnce);
    place.write("lost", "1");
    REQUIRE(place.submit({"room.xml", "--tasks", "2"}).code == 0);
    CHECK(contains(read_file(place.path("merge.log")), "slice 1/2 lacks the samples 0:2"));
    place.write("lost", "");
    REQUIRE(place.submit({"room.xml", "--tasks", "2"}).code == 0);
    CHECK(contains(read_file(place.path("log")), "goes on from room.slurm/4spp-slice-2-of-2.exr"));
    REQUIRE(place.run({"room.xml", "-o", "whole.exr", "-q"}).code == 0);
    CHECK(place.image("room.exr").data == place.image("whole.exr").data);
  }

  TEST_CASE("slurm: --dry-run prints the scripts of examples/ and leaves nothing") {
    const fs::path root = fs::path(source_path("")).parent_path();
    const fs::path examples = root / "examples" / "slurm";
    const auto example = [&](const char* name) { return read_file((examples / name).string()); };
    const Outcome o = run_duet({"slurm", "scenes/cornell-box", "--tasks", "16", "--time", "0:30:00",
                                "--program", "duet", "--dry-run", "--", "--spp", "1024"},
                               {.directory = root.string()});
    CHECK(o.code == 0);
    CHECK(o.out == "# cornell-box.slurm/render.sh\n" + example("render.sh") +
                       "\n# cornell-box.slurm/merge.sh\n" + example("merge.sh") +
                       "\n# To submit them:\n" + example("submit.sh"));
    CHECK(!fs::exists(root / "cornell-box.slurm"));
    const std::string page = read_file((root / "docs" / "slurm.md").string());
    for (const char* name : {"render.sh", "merge.sh", "submit.sh"})
      CHECK(contains(page, "\n\n" + indented(example(name))));
  }

  TEST_CASE("slurm: the merge writes files in the form that is asked for") {
    const Cluster place;
    const std::vector<std::string> plain{"room.xml", "--tasks", "2", "--dry-run", "--"};
    std::vector<std::string> formed = plain;
    formed.insert(formed.end(),
                  {"--tonemap", "agx", "--png-depth", "16", "--aov-names", "nuke", "--exr-parts"});
    const auto merge_line = [&](const std::vector<std::string>& arguments) {
      const Outcome o = place.submit(arguments);
      REQUIRE_MESSAGE(o.code == 0, o.err);
      const size_t at = o.out.find(" merge ");
      REQUIRE(at != std::string::npos);
      return o.out.substr(at, o.out.find("\n\n", at) - at);
    };
    const std::string line = merge_line(formed);
    for (const char* option :
         {"--tonemap agx", "--png-depth 16", "--aov-names nuke", "--exr-parts"})
      CHECK(contains(line, option));
    CHECK(!contains(merge_line(plain), "--exr-parts"));
  }

  TEST_CASE("slurm: without sbatch, or with one that fails, nothing is left") {
    const Cluster place;
    const size_t files = place.count();
    const auto check = [&](const std::string& named, bool only_bin = false) {
      const Outcome o = place.submit({"room.xml", "--tasks", "2", "-o", "new/a.exr"}, only_bin);
      CAPTURE(o.err);
      CHECK(o.code == 1);
      CHECK(contains(o.err, named));
      CHECK(std::count(o.err.begin(), o.err.end(), '\n') == 1);
      CHECK(place.count() == files);
    };
    check("there is no sbatch", true);
    place.sbatch("echo 'sbatch: error: Invalid partition' >&2; exit 1\n");
    check("exit code 1 of sbatch: sbatch: error: Invalid partition");
    place.sbatch("echo 'Hello, world'\n");
    check("sbatch printed \"Hello, world\"");
    place.sbatch("kill -SEGV $$\n");
    check("exit code 139");
    // The tasks are on their way then, and need their folder.
    place.sbatch("[ $# = 2 ] || exit 4; echo 12\n");
    const Outcome o = place.submit({"room.xml", "--tasks", "2"});
    CHECK(o.code == 1);
    CHECK(contains(o.err, "room.slurm/merge.sh was not submitted"));
    CHECK(contains(o.err, "the tasks are job 12"));
    CHECK(place.has("room.slurm/merge.sh"));
  }

  TEST_CASE("slurm: what cannot be rendered in slices is refused before anything is submitted") {
    const Cluster place;
    place.sbatch("touch called; echo 1\n");
    place.write("bad.xml", "<scene version=\"3.0.0\"><shape type=\"spere\"/></scene>");
    place.scene("copy.xml");
    const size_t files = place.count();
    struct Case {
      std::vector<std::string> arguments;
      int code;
      const char* named;
    };
    const Case cases[] = {
        {{"room.xml"}, 2, "--tasks"},
        {{"room.xml", "--tasks", "0"}, 2, "--tasks"},
        {{"room.xml", "--tasks", "5"}, 2, "--tasks 5: room.xml is rendered with 4 samples"},
        {{"room.xml", "--tasks", "5", "--", "--spp", "3"}, 2, "with 3 samples"},
        {{"room.xml", "--tasks", "2", "--time", "10m"}, 2, "no time limit of Slurm"},
        {{"room.xml", "--tasks", "2", "--time", "2"}, 2, "180 s at least"},
        {{"room.xml", "--tasks", "2", "--sbatch", "--array=1-9"}, 2, "--array"},
        {{"room.xml", "--tasks", "2", "--", "--time", "60s"}, 2, "time limit of Slurm"},
        {{"room.xml", "--tasks", "2", "--", "--target-error", "1%"}, 2, "cut into slices"},
        {{"room.xml", "--tasks", "2", "--", "--slice", "1/2"}, 2, "--slice"},
        {{"room.xml", "--tasks", "2", "--", "--raw", "a.exr"}, 2, "--raw"},
        {{"room.xml", "--tasks", "2", "--", "-o", "a.exr"}, 2, "it goes before --"},
        {{"room.xml", "--tasks", "2", "--", "--stats", "a.json"}, 2, "--stats"},
        {{"room.xml", "--tasks", "2", "--", "--no-such"}, 2, "--no-such"},
        {{"room.xml", "--tasks", "2", "--", "-I", "max_dept=3"}, 2, "max_depth"},
        {{"room.xml", "--tasks", "2", "--", "-s", "3"}, 2, "1 sensor"},
        {{"room.xml", "--tasks", "2", "-o", "a{b}.exr"}, 2, "a{b}.exr"},
        {{"room.xml", "--tasks", "2", "-o", "a\\b.exr"}, 2, "backslash"},
        {{"room.xml", "copy.xml", "--tasks", "2", "-o", "a.exr"}, 2, "written to one file"},
        {{"-", "--tasks", "2"}, 2, "standard input"},
        {{"--tasks", "2", "--", "--spp", "8"}, 2, "no scene"},
        {{"gone.xml", "--tasks", "2"}, 1, "gone.xml"},
        {{"room.xml", "bad.xml", "--tasks", "2"}, 1, "did you mean \"sphere\"?"},
    };
    for (const Case& c : cases) {
      const Outcome o = place.submit(c.arguments);
      CAPTURE(c.named);
      CAPTURE(o.err);
      CHECK(o.code == c.code);
      CHECK(contains(o.err, c.named));
      CHECK(place.count() == files);
    }
  }

  TEST_CASE("slurm: every scene has its own jobs") {
    const Cluster place;
    place.scene("hall.xml");
    place.sbatch(kAtOnce);
    place.write("lost", "");
    const Outcome o =
        place.submit({"room.xml", "hall.xml", "--tasks", "2", "-o", "images/{scene}-{spp}.exr"});
    REQUIRE_MESSAGE(o.code == 0, o.err);
    CHECK(place.has("images/room-4.exr"));
    CHECK(place.has("images/hall-4.exr"));
    CHECK(place.has("images/hall-4.slurm/render.sh"));
  }

  TEST_CASE("slurm: names that begin with a dash are no options") {
    const Cluster place;
    place.scene("-hall.xml");
    place.sbatch(kAtOnce);
    place.write("lost", "");
    place.write("-jobs.csv", "scene,output\n-hall.xml,-b.exr\n");
    for (const auto& [operand, image] :
         {std::pair{"./-hall.xml", "-hall.exr"}, {"./-jobs.csv", "-b.exr"}}) {
      const Outcome o = place.submit({operand, "--tasks", "2", "--", "--spp", "4"});
      CHECK_MESSAGE(o.code == 0, o.err);
      CHECK(place.has(image));
    }
    for (const char* option : {" -hall", " -b"})
      CHECK(!contains(read_file(place.path("calls")), option));
    const Outcome o = place.submit({"--tasks", "2", "--", "-hall.xml"});
    CHECK(o.code == 2);
    CHECK(contains(o.err, "a file whose name begins with a dash is called ./-name"));
  }

  TEST_CASE("slurm: lists of jobs are those of batch") {
    const Cluster place;
    place.sbatch(kAtOnce);
    place.write("lost", "");
    place.write("jobs.csv", "scene,spp,output,seed\nroom.xml,8,a.exr;a.png,\nroom.xml,,b.exr,3\n");
    const Outcome o = place.submit({"jobs.csv", "--tasks", "2", "--", "--spp", "6"});
    REQUIRE_MESSAGE(o.code == 0, o.err);
    CHECK(place.has("a.png"));
    CHECK(place.has("a.slurm/8spp-slice-2-of-2.exr"));
    REQUIRE(place.run({"room.xml", "--spp", "6", "--seed", "3", "-o", "whole.exr", "-q"}).code ==
            0);
    CHECK(place.image("b.exr").data == place.image("whole.exr").data);
    CHECK(place.image("a.exr").data != place.image("whole.exr").data);

    fs::remove(place.path("calls"));
    const std::pair<const char*, const char*> refused[] = {
        {"scene,sp\nroom.xml,8\n", "jobs.csv:1"},
        {"scene,spp\nroom.xml,8\ngone.xml,8\n", "jobs.csv:3"},
        {"scene,spp\nroom.xml,1\n", "jobs.csv:2"},
        {"scene,time\nroom.xml,10s\n", "cut into slices"},
        {"scene,output\nroom.xml,a.exr\nroom.xml,a.png\n", "a.slurm"}};
    for (const auto& [list, named] : refused) {
      place.write("jobs.csv", list);
      const Outcome r = place.submit({"jobs.csv", "--tasks", "2"});
      CHECK(r.code == 2);
      CHECK_MESSAGE(contains(r.err, named), r.err);
    }
    CHECK(!place.has("calls"));
  }

  TEST_CASE("merge: slices are checked only if all is said about them") {
    const Cluster place;
    REQUIRE(place.run({"room.xml", "--slice", "1/2", "--raw", "a.exr", "-q"}).code == 0);
    const std::pair<std::vector<std::string>, const char*> refused[] = {
        {{"--slices", "2"}, "belong together"},
        {{"--spp", "4"}, "belong together"},
        {{"--slices", "9", "--spp", "4"}, "--slices"},
        {{"--slice-command", "x"}, "--slice-command"}};
    for (const auto& [options, named] : refused) {
      std::vector<std::string> all{"merge", "a.exr", "-o", "b.exr"};
      all.insert(all.end(), options.begin(), options.end());
      const Outcome o = place.run(all);
      CHECK(o.code == 2);
      CHECK(contains(o.err, named));
    }
    const Outcome none =
        place.run({"merge", "c.exr", "--slices", "2", "--spp", "4", "-o", "b.exr"});
    CHECK(none.code == 1);
    CHECK(contains(none.err, "slice 2/2 lacks the samples 2:4\n"));
    CHECK(contains(none.err, "none of the films is there"));
    CHECK(!place.has("b.exr"));
    REQUIRE(place.run({"room.xml", "--target-error", "50%", "--spp", "16", "--raw", "e.exr", "-q"})
                .code == 0);
    const Outcome spread =
        place.run({"merge", "e.exr", "--slices", "2", "--spp", "16", "-o", "b.exr"});
    CHECK(spread.code == 1);
    CHECK(contains(spread.err, "a render with --target-error has none"));
    // Without --slices a film that is not there is a mistake.
    CHECK(place.run({"merge", "a.exr", "c.exr", "-o", "b.exr"}).code == 1);
    CHECK(!place.has("b.exr"));
  }
}
