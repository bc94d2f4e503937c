#include "base/system/descriptor.h"

#include <unistd.h>

namespace duet {

void Descriptor::close() {
  if (number_ >= 0) ::close(std::exchange(number_, -1));
}

}  // namespace duet
