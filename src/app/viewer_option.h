// --display: the viewer that shows an image as it grows.
#pragma once

#include <string>

#include "base/system/tcp.h"

namespace duet {

/// The viewer that --display names: "tev", "tev://host" or "tev://host:port". Throws UsageError,
/// also if there is no such host; whether somebody listens there is not asked.
TcpPeer parse_viewer(const std::string& text);

}  // namespace duet
