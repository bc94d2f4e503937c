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
  constexpr std::string_view scheme = "tev";
  const auto refuse = [&] {
    throw UsageError(
        fmt::format("--display {}: a viewer is tev, tev://HOST or tev://HOST:PORT", text));
  };
  TcpAddress viewer;
  viewer.port = kTevPort;
  if (text == scheme) return find_viewer(viewer);
  if (!text.starts_with("tev://")) refuse();
  std::string host = text.substr(6), port;
  // An IPv6 address has colons of its own.
  const size_t bracket = host.find(']'), colon = host.find(':', bracket == host.npos ? 0 : bracket);
  if (colon != host.npos) {
    port = host.substr(colon + 1);
    host.erase(colon);
    viewer.port = uint16_t(
        parse_whole("--display", port, 1, std::numeric_limits<decltype(viewer.port)>::max()));
  }
  if (host.starts_with('[')) {
    if (!host.ends_with(']')) refuse();
    host = host.substr(1, host.size() - 2);
  }
  if (host.empty()) refuse();
  viewer.host = host;
  return find_viewer(viewer);
}

}  // namespace duet
