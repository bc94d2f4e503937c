#include "base/system/tcp.h"

#include <fmt/format.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>

namespace duet {

namespace {

/// How often somebody who waits looks whether he should stop.
constexpr int kMillisecondsBetweenLooks = 50;

using Clock = std::chrono::steady_clock;

/// Whether the socket can be written to, or has failed, after so many milliseconds.
bool is_writable(int socket, int milliseconds) {
  pollfd wait{socket, POLLOUT, 0};
  return poll(&wait, 1, milliseconds) > 0;
}

/// The same after so many seconds, whatever signals arrive.
bool becomes_writable(int socket, double seconds) {
  const Clock::time_point end = Clock::now() + std::chrono::milliseconds(int(1000 * seconds));
  do {
    if (is_writable(socket, kMillisecondsBetweenLooks)) return true;
  } while (Clock::now() < end);
  return false;
}

/// The error of connecting; 0 if there is none.
int connect_within(int socket, const addrinfo& to, double seconds) {
  if (connect(socket, to.ai_addr, to.ai_addrlen) == 0) return 0;
  if (errno != EINPROGRESS) return errno;
  if (!becomes_writable(socket, seconds)) return ETIMEDOUT;
  int error = 0;
  socklen_t size = sizeof(error);
  getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size);
  return error;
}

}  // namespace

TcpPeer::TcpPeer(const TcpAddress& address) : address_(address) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int error =
      getaddrinfo(address.host.c_str(), fmt::to_string(address.port).c_str(), &hints, &found);
  if (error != 0)
    throw std::runtime_error(fmt::format("{}: {}", address.text(), gai_strerror(error)));
  found_ = {found, freeaddrinfo};
}

TcpConnection::TcpConnection(const TcpPeer& peer, double seconds) {
  int error = EADDRNOTAVAIL;
  for (auto a = static_cast<const addrinfo*>(peer.found_.get()); a; a = a->ai_next) {
    socket_ = Descriptor(socket(a->ai_family, a->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    if (socket_.number() < 0) continue;
    error = connect_within(socket_.number(), *a, seconds);
    if (error == 0) return;
  }
  throw std::runtime_error(fmt::format("{}: {}", peer.address().text(), std::strerror(error)));
}

void TcpConnection::send(std::span<const uint8_t> bytes, double seconds,
                         const std::atomic<bool>& cancel) {
  Clock::time_point last = Clock::now();
  while (!bytes.empty()) {
    const ssize_t n = ::send(socket_.number(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (n > 0) {
      bytes = bytes.subspan(size_t(n));
      last = Clock::now();
      continue;
    }
    if (n < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR)
      throw std::runtime_error(std::strerror(errno));
    is_writable(socket_.number(), kMillisecondsBetweenLooks);
    if (cancel.load()) throw std::runtime_error("there was no time to send all of it");
    if (std::chrono::duration<double>(Clock::now() - last).count() > seconds)
      throw std::runtime_error(std::strerror(ETIMEDOUT));
  }
}

}  // namespace duet
