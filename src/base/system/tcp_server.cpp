#include "base/system/tcp_server.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <system_error>
#include <vector>

namespace duet {

namespace {

/// What a call has moved: nothing if it failed for good.
std::optional<size_t> moved(ssize_t n) {
  if (n >= 0) return size_t(n);
  const bool is_for_later = errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
  return is_for_later ? std::optional<size_t>(0) : std::nullopt;
}

}  // namespace

std::optional<size_t> TcpClient::receive(std::span<char> room) const {
  const ssize_t n = recv(socket_.number(), room.data(), room.size(), 0);
  return n == 0 ? std::nullopt : moved(n);
}

std::optional<size_t> TcpClient::send(std::string_view bytes) const {
  return moved(::send(socket_.number(), bytes.data(), bytes.size(), MSG_NOSIGNAL));
}

void TcpClient::end_sending() const {
  shutdown(socket_.number(), SHUT_WR);
}

TcpServer::TcpServer(uint16_t port, int most_waiting)
    : socket_(socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
  const int s = socket_.number();
  const auto fail = [] { throw std::system_error(errno, std::generic_category()); };
  if (s < 0) fail();
  // What the render before left waiting is no reason to refuse its port.
  const int yes = 1;
  setsockopt(s, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(port);
  socklen_t size = sizeof(address);
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  if (bind(s, any, size) != 0 || listen(s, most_waiting) != 0 || getsockname(s, any, &size) != 0)
    fail();
  port_ = ntohs(address.sin_port);
}

std::optional<TcpClient> TcpServer::accept() const {
  Descriptor client(accept4(socket_.number(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (client.number() < 0) return std::nullopt;
  return TcpClient(std::move(client));
}

bool TcpServer::wait(std::span<Wait> clients, int milliseconds) const {
  std::vector<pollfd> waits{{socket_.number(), POLLIN, 0}};
  for (const Wait& w : clients)
    waits.push_back({w.client->socket_.number(), short(w.is_to_send ? POLLOUT : POLLIN), 0});
  poll(waits.data(), waits.size(), milliseconds);
  for (size_t i = 0; i < clients.size(); ++i) clients[i].is_ready = waits[i + 1].revents != 0;
  return waits[0].revents != 0;
}

}  // namespace duet
