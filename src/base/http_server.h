// A server for pages of this program, to be looked at on the same machine.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "base/system/tcp_server.h"

namespace duet {

struct HttpAnswer {
  int status = 200;  ///< of RFC 9110; those that have a text are 200, 204, 400, 403, 404, 405, 431
  std::string type = "text/plain; charset=utf-8";
  std::string body;
};

/// Answers GET requests (HTTP/1.1, RFC 9112) on the loopback interface from a thread of its own,
/// one request for each connection. Nobody can hold it up: it waits for all connections at once,
/// keeps sixteen of them, those that have done something last, and takes eight kilobytes of each.
/// Requests for other hosts are refused, so that no page of the web reads ours by a name
/// that leads here (DNS rebinding).
class HttpServer {
 public:
  /// What a path, with its query, is answered by; called from the server's thread.
  using Handler = std::function<HttpAnswer(const std::string& target)>;

  /// Port 0 is any that is free. Throws std::system_error if the port is taken, or if there is no
  /// thread.
  HttpServer(uint16_t port, Handler handler);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  uint16_t port() const { return server_.port(); }

 private:
  struct Client;

  void work();
  /// Takes a new connection in the place of the one that has been idle for longest, if there are
  /// too many.
  void accept_client(std::vector<Client>& clients) const;
  /// Reads or sends what there is. False when the connection is to be closed.
  bool go_on(Client& client) const;
  bool read_request(Client& client) const;
  std::string answer(const std::string& request) const;

  const Handler handler_;
  const TcpServer server_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace duet
