#include "app/viewer_option.h"

#include <fmt/format.h>

#include <limits>

#include "app/arguments.h"
#include "base/failures.h"
#include "evaluate/live/tev_display.h"

namespace duet {

namespace {

TcpPeer find_viewer(const TcpAddress& viewer) {
  try {
    return TcpPeer(viewer);
  } catch (const std::runtime_error& e) {
    throw UsageError(fmt::format("--display: {}", e.what()));
  }
}

}  // namespace

TcpPeer parse_viewer(const std::string& text) {
  TcpAddress viewer;
  viewer.port = kTevPort;
  if (text == "tev") return find_viewer(viewer);
  const auto parts = text.starts_with("tev://") ? split_address(text.substr(6)) : std::nullopt;
  if (!parts)
    throw UsageError(
        fmt::format("--display {}: a viewer is tev, tev://HOST or tev://HOST:PORT", text));
  viewer.host = parts->host;
  if (parts->port)
    viewer.port = uint16_t(parse_whole("--display", *parts->port, 1,
                                       std::numeric_limits<decltype(viewer.port)>::max()));
  return find_viewer(viewer);
}

}  // namespace duet
