// Raw films of one image, added up.
#pragma once

#include <string>
#include <vector>

#include "evaluate/raw/raw_film.h"
#include "integrators/pass.h"

namespace duet {

struct MergedFilms {
  RawImage image;
  RenderState state;
  RenderResult result;  ///< the image, and the estimate of its error
  size_t films = 0;
  std::vector<SampleInterval> gaps;  ///< samples before the last that no film has
};

/// Adds up raw films, in whatever order they are named; one is in memory at a time. Throws
/// ReadError, which names the files, if one cannot be read or is damaged, if two are not of one
/// image (difference()) or have samples in common, and TooLittleMemory if
/// there is no room for the sums and the image.
MergedFilms merge_raw_films(const std::vector<std::string>& paths);

/// The facts of all of them together.
RenderRecord record_of(const MergedFilms& merged);
/// What their image says of itself; `gaps` are the samples that are missing, as text.
HeaderFields header_of(const MergedFilms& merged, const RenderRecord& record,
                       const std::string& gaps);

}  // namespace duet
