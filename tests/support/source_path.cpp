#include "support/source_path.h"

namespace duet::test {

std::string source_path(const std::string& path) {
  return DUET_SOURCE_DIR "/" + path;
}

}  // namespace duet::test
