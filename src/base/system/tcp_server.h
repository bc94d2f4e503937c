// The server's side of TCP connections: what base/http_server.h is made of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "base/system/descriptor.h"

namespace duet {

/// A connection to a client. Nothing here waits.
class TcpClient {
 public:
  /// How many bytes have arrived, none if that is for later. Nothing if the connection is over.
  std::optional<size_t> receive(std::span<char> room) const;
  /// How many bytes have been sent, likewise. A client that has gone raises no signal.
  std::optional<size_t> send(std::string_view bytes) const;
  /// Says that nothing more will be sent, so that what was sent is not lost by closing while
  /// something is unread.
  void end_sending() const;

 private:
  friend class TcpServer;
  explicit TcpClient(Descriptor socket) : socket_(std::move(socket)) {}

  Descriptor socket_;
};

/// Takes connections from this machine.
class TcpServer {
 public:
  /// Port 0 is any that is free. So many clients are kept waiting for accept(). Throws
  /// std::system_error if the port is taken.
  TcpServer(uint16_t port, int most_waiting);
  uint16_t port() const { return port_; }

  /// A client that has come; nothing if there is none.
  std::optional<TcpClient> accept() const;

  struct Wait {
    const TcpClient* client;
    bool is_to_send;        ///< rather than to receive
    bool is_ready = false;  ///< whether it can do so, or has failed
  };
  /// Waits for any of the clients, a new client or so many milliseconds. True if a new one has
  /// come.
  bool wait(std::span<Wait> clients, int milliseconds) const;

 private:
  Descriptor socket_;
  uint16_t port_ = 0;
};

}  // namespace duet
