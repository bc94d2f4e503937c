// TCP connections to other programs, which may be slow or gone. Servers are base/http_server.h.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

struct addrinfo;

namespace duet {

/// Where a program listens.
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

/// The addresses that a host has. Looking them up takes as long as it takes.
class TcpPeer {
 public:
  /// Throws std::runtime_error if there is no such host.
  explicit TcpPeer(const TcpAddress& address);
  const TcpAddress& address() const { return address_; }

 private:
  friend class TcpConnection;
  TcpAddress address_;
  std::shared_ptr<const addrinfo> found_;
};

/// One connection. Nothing here blocks for longer than it is told to, and a peer that goes away
/// raises no signal.
class TcpConnection {
 public:
  /// Tries each address for so many seconds. Throws std::runtime_error with the reason.
  TcpConnection(const TcpPeer& peer, double seconds);
  ~TcpConnection();
  TcpConnection(const TcpConnection&) = delete;
  TcpConnection& operator=(const TcpConnection&) = delete;

  /// Sends all bytes. Throws std::runtime_error if the peer has gone, takes nothing for `seconds`,
  /// or if `cancel` is set before.
  void send(std::span<const uint8_t> bytes, double seconds, const std::atomic<bool>& cancel);

 private:
  int socket_ = -1;
};

}  // namespace duet
