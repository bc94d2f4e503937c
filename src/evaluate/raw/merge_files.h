// Raw films in, files out: what `duet merge` does.
#pragma once

#include <string>
#include <vector>

#include "base/messages.h"
#include "evaluate/raw/expected_slices.h"
#include "evaluate/report/file_settings.h"

namespace duet {

struct MergeRequest {
  std::vector<std::string> films;
  std::vector<std::string> outputs;  ///< images: .exr, .png or .jpg
  std::string raw, stats;            ///< files for all films as one and for statistics, or ""
  FileSettings files;
  ExpectedSlices slices;     ///< those that the films should be
  std::string command_line;  ///< for the header of images
  int threads = 1;           ///< for the statistics
};

/// Adds up the films and writes what is asked for. Whether they have all samples that they should:
/// a message names each slice that is not complete. Throws UsageError for images that cannot hold
/// the layers and files with two uses, and std::runtime_error, also as merge_raw_films() does.
bool merge_to_files(MergeRequest request, Messages& messages);

}  // namespace duet
