// What Slurm's `sbatch` understands and says (https://slurm.schedmd.com/sbatch.html).
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace duet::slurm {

/// A time limit in seconds; infinity if there is none. Its forms are minutes, minutes:seconds,
/// hours:minutes:seconds, days-hours, days-hours:minutes and days-hours:minutes:seconds; 0,
/// "infinite" and "unlimited" are no limit. Nothing if it has none of them.
std::optional<double> time_limit(const std::string& text);

/// Why a further option for the scripts cannot be used, as it would stand behind #SBATCH; empty if
/// it can.
std::string option_refusal(const std::string& line);

/// The options of sbatch, as they stand behind #SBATCH; `time` and `partition` may be empty. Throws
/// UsageError for one that cannot be used, and for a time limit that leaves no time to render.
std::vector<std::string> sbatch_options(const std::string& time, const std::string& partition,
                                        const std::vector<std::string>& others);

/// A path as the value of --output, in which a percent sign means something else. In a path with a
/// backslash nothing is replaced: it cannot be had.
std::string output_pattern(const std::string& path);

/// A job that was submitted with --parsable: its number, and its cluster if there are several.
struct SubmittedJob {
  std::string number, cluster;
};
/// Nothing if the text is not what `sbatch --parsable` prints.
std::optional<SubmittedJob> submitted_job(const std::string& text);

}  // namespace duet::slurm
