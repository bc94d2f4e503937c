#include "support/http.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <stdexcept>

namespace duet::test {

Connection::Connection(uint16_t port) : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(port);
  if (connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof(address)) == 0) return;
  close(socket_);
  throw std::runtime_error("nobody listens at port " + std::to_string(port));
}

Connection::~Connection() {
  close(socket_);
}

void Connection::send(const std::string& bytes) const {
  if (::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) != ssize_t(bytes.size()))
    throw std::runtime_error("the server takes nothing");
}

std::string Connection::receive() const {
  std::string text;
  char block[4096];
  pollfd wait{socket_, POLLIN, 0};
  while (poll(&wait, 1, 60'000) > 0) {
    const ssize_t n = recv(socket_, block, sizeof(block), 0);
    if (n <= 0) break;
    text.append(block, size_t(n));
  }
  return text;
}

std::string http(uint16_t port, const std::string& request) {
  const Connection c(port);
  c.send(request);
  return c.receive();
}

HttpReply http_get(uint16_t port, const std::string& target) {
  const std::string text = http(
      port, "GET " + target + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) + "\r\n\r\n");
  const size_t status = text.find(' '), body = text.find("\r\n\r\n");
  if (status == text.npos || body == text.npos) return {0, text};
  return {std::stoi(text.substr(status + 1)), text.substr(body + 4)};
}

}  // namespace duet::test
