#include "evaluate/slurm/scripts.h"

#include <doctest/doctest.h>

#include "base/system/run_program.h"
#include "support/files.h"

using namespace duet;
using namespace duet::test;

namespace {

/// Names that shells and sbatch would take apart.
const std::string kOdd = "it's 100% \"$HOME\" `id` #1";

slurm::ImageJob odd_job(const TemporaryDirectory& place) {
  slurm::ImageJob job;
  // Prints what it was given.
  job.program = place.write("du et", "#!/bin/sh\nprintf '%s|' \"$@\"\n");
  std::filesystem::permissions(job.program, std::filesystem::perms::owner_all);
  job.scene = kOdd + ".xml";
  job.render_options = {"-D", "a=" + kOdd, "--spp", "8"};
  job.merge_options = {"-o", kOdd + ".exr"};
  job.name = kOdd;
  job.folder = kOdd + ".slurm";
  job.spp = 8;
  job.tasks = 3;
  job.sbatch_options = {"--mem=8G"};
  return job;
}

std::string run(const TemporaryDirectory& place, const std::string& script) {
  place.write("script", script);
  const ProgramEnd end = run_program({"env", "-C", place.path(""), "SLURM_ARRAY_TASK_ID=2",
                                      "SLURM_CPUS_ON_NODE=5", "bash", "script"});
  CHECK(end.err.empty());
  return end.out;
}

/// What --slice-command is in the arguments of a merge.
std::string slice_command(const std::string& arguments) {
  const std::string option = "--slice-command|";
  const size_t at = arguments.find(option) + option.size();
  return arguments.substr(at, arguments.size() - at - 1);
}

}  // namespace

TEST_CASE("a task is given the names as they are") {
  const TemporaryDirectory place;
  slurm::ImageJob job = odd_job(place);
  const std::string given = "render|" + job.scene + "|-D|a=" + kOdd +
                            "|--spp|8|--slice|2/3|--raw|" + job.folder + "/8spp-slice-2-of-3.exr|";
  CHECK(run(place, slurm::render_script(job)) == given + "--threads|5|");
  job.has_threads = true;
  CHECK(run(place, slurm::render_script(job)) == given);
}

TEST_CASE("a merge is given all films, and a command that renders a slice") {
  const TemporaryDirectory place;
  const slurm::ImageJob job = odd_job(place);
  const std::string out = run(place, slurm::merge_script(job));
  std::string films;
  for (const char* k : {"1", "2", "3"}) films += job.folder + "/8spp-slice-" + k + "-of-3.exr|";
  CHECK(out.starts_with("merge|" + films + "-o|" + kOdd + ".exr|--slices|3|--spp|8|"));
  std::string command = slice_command(out);
  for (size_t at; (at = command.find("{slice}")) != std::string::npos;) command.replace(at, 7, "2");
  CHECK(run(place, command) == "render|" + job.scene + "|-D|a=" + kOdd +
                                   "|--spp|8|--slice|2/3|--raw|" + job.folder +
                                   "/8spp-slice-2-of-3.exr|");
}

TEST_CASE("sbatch finds its options in the scripts") {
  const TemporaryDirectory place;
  slurm::ImageJob job = odd_job(place);
  job.name = "a", job.folder = "100%/a b.slurm";
  const std::string render = slurm::render_script(job), merge = slurm::merge_script(job);
  for (const char* line :
       {"#SBATCH --job-name=a\n", "#SBATCH --array=1-3\n", "#SBATCH --requeue\n",
        "#SBATCH --output='100%%/a b.slurm/slice-%a.log'\n", "#SBATCH --open-mode=append\n",
        "#SBATCH --signal=B:TERM@60\n", "#SBATCH --mem=8G\n"}) {
    CAPTURE(line);
    CHECK(render.find(line) < render.find("\nexec "));
  }
  CHECK(merge.find("#SBATCH --output='100%%/a b.slurm/merge.log'\n") < merge.find("\nexec "));
  CHECK(merge.find("#SBATCH --mem=8G\n") < merge.find("\nexec "));
  CHECK(merge.find("--array") == merge.npos);
  CHECK(slurm::submit_merge(job, "7") == std::vector<std::string>{"sbatch", "--parsable",
                                                                  "--dependency=afterany:7",
                                                                  "100%/a b.slurm/merge.sh"});
}
