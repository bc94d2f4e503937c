// The sizes that the headers of an OpenEXR file claim.
#pragma once

#include <OpenEXR/ImfIO.h>

namespace duet {

/// Reads the headers of all parts and throws std::runtime_error if an image or a tile is larger
/// than is read, before OpenEXR makes tables for their lines and tiles. Leaves the stream at its
/// beginning. OpenEXR's own limits would hold for everything in the process that reads such files.
void check_sizes(Imf::IStream& stream);

}  // namespace duet
