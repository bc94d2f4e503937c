// TCP connections to other programs, which may be slow or gone. Servers are base/http_server.h.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>

#include "base/system/descriptor.h"
#include "base/tcp_address.h"

namespace duet {

/// The addresses that a host has. Looking them up takes as long as it takes.
class TcpPeer {
 public:
  /// Throws std::runtime_error if there is no such host.
  explicit TcpPeer(const TcpAddress& address);
  const TcpAddress& address() const { return address_; }

 private:
  friend class TcpConnection;

  TcpAddress address_;
  std::shared_ptr<const void> found_;  ///< a list of the system's own type
};

/// One connection. Nothing here blocks for longer than it is told to, and a peer that goes away
/// raises no signal.
class TcpConnection {
 public:
  /// Tries each address for so many seconds. Throws std::runtime_error with the reason.
  TcpConnection(const TcpPeer& peer, double seconds);

  /// Sends all bytes. Throws std::runtime_error if the peer has gone, takes nothing for `seconds`,
  /// or if `cancel` is set before.
  void send(std::span<const uint8_t> bytes, double seconds, const std::atomic<bool>& cancel);

 private:
  Descriptor socket_;
};

}  // namespace duet
