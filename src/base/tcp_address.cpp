#include "base/tcp_address.h"

#include <fmt/format.h>

namespace duet {

std::string TcpAddress::text() const {
  return host.find(':') == std::string::npos ? fmt::format("{}:{}", host, port)
                                             : fmt::format("[{}]:{}", host, port);
}

std::optional<AddressParts> split_address(const std::string& text) {
  AddressParts parts{text, std::nullopt};
  std::string& host = parts.host;
  // An IPv6 address has colons of its own.
  const size_t bracket = host.find(']'), colon = host.find(':', bracket == host.npos ? 0 : bracket);
  if (colon != host.npos) {
    parts.port = host.substr(colon + 1);
    host.erase(colon);
  }
  if (host.starts_with('[')) {
    if (!host.ends_with(']')) return std::nullopt;
    host = host.substr(1, host.size() - 2);
  }
  return host.empty() ? std::nullopt : std::optional(parts);
}

}  // namespace duet
