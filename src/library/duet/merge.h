// Raw films, which `duet render --raw` writes.
#pragma once

#include <string>
#include <vector>

#include <duet/rendered_image.h>

namespace duet {

/// Adds up raw films of one image, as `duet merge` does; samples that are missing before the last
/// are in the image's metadata ("missingSamples"). Throws FileError if a film cannot be read or
/// does not go with the others, std::invalid_argument if they have no samples, and MemoryError.
[[gnu::visibility("default")]] RenderedImage merge_films(const std::vector<std::string>& films);

}  // namespace duet
