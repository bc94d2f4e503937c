#include "image/library_versions.h"

#include <OpenEXR/OpenEXRConfig.h>
#include <OpenImageIO/oiioversion.h>

namespace duet {

const char* openexr_version() {
  return OPENEXR_VERSION_STRING;
}

const char* openimageio_version() {
  return OIIO_VERSION_STRING;
}

}  // namespace duet
