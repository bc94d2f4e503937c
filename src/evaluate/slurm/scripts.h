// The scripts by which Slurm renders an image in slices and adds them up (docs/slurm.md).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace duet::slurm {

/// Tasks are told to stop so long before their time limit; Slurm may do it a minute earlier.
inline constexpr int kSecondsToStop = 60;
/// Stands for the number of a slice in names and commands.
inline const std::string kSlice = "{slice}";

/// An image that the tasks of a job array render.
struct ImageJob {
  std::string program;  ///< `duet` as the nodes find it
  std::string scene;
  std::vector<std::string> render_options;  ///< all but --slice, --raw and perhaps --threads
  bool has_threads = false;                 ///< whether they say how many
  std::vector<std::string> merge_options;   ///< all but the raw films and what is lost
  std::string name;                         ///< in Slurm's lists
  std::string folder;                       ///< of scripts, raw films and messages
  uint32_t spp = 1, tasks = 1;
  std::vector<std::string> sbatch_options;  ///< of both jobs, as they stand behind #SBATCH
};

/// Calls the job after its image, beside which its folder is. Throws UsageError if the scripts
/// could not name that.
void name_job(ImageJob& job, const std::string& image);

std::string render_script_path(const ImageJob& job);
std::string merge_script_path(const ImageJob& job);

/// The script of the array's tasks. All names in it are quoted for the shell and for sbatch; the
/// folder must have no backslash, brace or control character.
std::string render_script(const ImageJob& job);

/// The script of the job that waits for all tasks, whatever came of them.
std::string merge_script(const ImageJob& job);

/// How both are submitted by hand.
std::string submit_script(const ImageJob& job);

/// The arguments by which they are submitted; `dependency` is the number of the array's job.
std::vector<std::string> submit_render(const ImageJob& job);
std::vector<std::string> submit_merge(const ImageJob& job, const std::string& dependency);

}  // namespace duet::slurm
