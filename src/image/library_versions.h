// Versions of the libraries that read and write images.
#pragma once

namespace duet {

/// Such as "3.1.5".
const char* openexr_version();
/// That of the module duet_oiio.so, which is loaded when the first image needs it.
const char* openimageio_version();

}  // namespace duet
