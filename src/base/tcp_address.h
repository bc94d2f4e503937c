// Where a program listens for TCP connections.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace duet {

struct TcpAddress {
  std::string host = "127.0.0.1";
  uint16_t port = 0;

  /// "host:port"; an IPv6 address stands in brackets.
  std::string text() const;
};

/// The parts of such a text, which may have no port. Nothing if it has no host.
struct AddressParts {
  std::string host;
  std::optional<std::string> port;
};
std::optional<AddressParts> split_address(const std::string& text);

}  // namespace duet
