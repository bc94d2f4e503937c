#include "evaluate/raw/expected_slices.h"

#include <filesystem>
#include <stdexcept>

#include "evaluate/raw/slices.h"

namespace duet {

void ExpectedSlices::leave_out_missing(std::vector<std::string>& films) const {
  std::error_code ignored;
  if (are_known())
    std::erase_if(films, [&](const auto& path) { return !std::filesystem::exists(path, ignored); });
}

std::vector<SampleInterval> ExpectedSlices::gaps(const MergedFilms& merged) const {
  if (!are_known()) return merged.gaps;
  if (merged.state.films.size() > 1)
    throw std::runtime_error("--slices: a render with --target-error has none");
  return merged.state.samples.missing_from({0, spp_});
}

std::vector<std::string> ExpectedSlices::incomplete(const SampleIntervals& samples) const {
  std::vector<std::string> sentences;
  for (const auto& [number, missing] : incomplete_slices(samples, spp_, count_)) {
    std::string how = command_;
    for (size_t at = 0; (at = how.find("{slice}", at)) != std::string::npos;)
      how.replace(at, 7, std::to_string(number));
    sentences.push_back(fmt::format("slice {}/{} lacks the samples {}{}{}", number, count_,
                                    to_string(missing),
                                    how.empty() ? "" : "; render them with: ", how));
  }
  return sentences;
}

}  // namespace duet
