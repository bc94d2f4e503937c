// What a browser would send to a server of this machine.
#pragma once

#include <cstdint>
#include <string>

namespace duet::test {

/// An open connection to a port of the loopback interface.
class Connection {
 public:
  /// Throws std::runtime_error if nobody listens.
  explicit Connection(uint16_t port);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void send(const std::string& bytes) const;
  /// All that comes until the other end closes, or for a minute nothing.
  std::string receive() const;

 private:
  int socket_;
};

/// The answer to these bytes, headers included.
std::string http(uint16_t port, const std::string& request);

struct HttpReply {
  int status = 0;
  std::string body;
};
HttpReply http_get(uint16_t port, const std::string& target);

}  // namespace duet::test
