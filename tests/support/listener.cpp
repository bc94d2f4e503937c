#include "support/listener.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <system_error>
#include <vector>

namespace duet::test {

namespace {

constexpr int kMillisecondsBetweenLooks = 20;
/// Small, so that what is not read soon fills what the system keeps.
constexpr int kReceiveBuffer = 4096;
constexpr std::chrono::seconds kPatience{20};

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

/// A socket bound to a free port of the loopback interface.
int bound_socket(uint16_t& port) {
  const int s = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (s < 0) fail("socket");
  setsockopt(s, SOL_SOCKET, SO_RCVBUF, &kReceiveBuffer, sizeof(kReceiveBuffer));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  if (bind(s, reinterpret_cast<sockaddr*>(&address), size) != 0) fail("bind");
  if (getsockname(s, reinterpret_cast<sockaddr*>(&address), &size) != 0) fail("getsockname");
  port = ntohs(address.sin_port);
  return s;
}

bool is_readable(int socket) {
  pollfd wait{socket, POLLIN, 0};
  return poll(&wait, 1, kMillisecondsBetweenLooks) > 0;
}

}  // namespace

Listener::Listener(Manner manner) : manner_(manner), socket_(bound_socket(port_)) {
  if (listen(socket_, 8) != 0) fail("listen");
  thread_ = std::thread([this] { work(); });
}

Listener::~Listener() {
  ends_ = true;
  thread_.join();
  close(socket_);
}

std::string Listener::received() {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  // A connection may be waiting still to be taken.
  do {
    std::this_thread::sleep_for(std::chrono::milliseconds(5 * kMillisecondsBetweenLooks));
  } while (open_ > 0 && std::chrono::steady_clock::now() < end);
  const std::lock_guard lock(mutex_);
  return bytes_;
}

void Listener::work() {
  while (!ends_) {
    if (!is_readable(socket_)) continue;
    const int connection = accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
    if (connection < 0) continue;
    ++connections_, ++open_;
    serve(connection);
    close(connection);
    --open_;
  }
}

void Listener::serve(int connection) {
  std::vector<char> buffer(manner_ == Manner::closes ? 100 : 1 << 20);
  while (!ends_) {
    if (manner_ == Manner::never_reads) {
      std::this_thread::sleep_for(std::chrono::milliseconds(kMillisecondsBetweenLooks));
      continue;
    }
    if (!is_readable(connection)) continue;
    const ssize_t n = recv(connection, buffer.data(), buffer.size(), 0);
    if (n <= 0) return;
    const std::lock_guard lock(mutex_);
    bytes_.append(buffer.data(), size_t(n));
    if (manner_ == Manner::closes) return;
  }
}

uint16_t silent_port() {
  uint16_t port = 0;
  close(bound_socket(port));
  return port;
}

}  // namespace duet::test
