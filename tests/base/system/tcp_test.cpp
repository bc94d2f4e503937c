// Connections to programs that take what they get, or do not.
#include "base/system/tcp.h"

#include <doctest/doctest.h>

#include <chrono>
#include <stdexcept>
#include <vector>

#include "support/listener.h"

using namespace duet;
using namespace duet::test;

namespace {

/// More than the system keeps of what nobody reads.
const std::vector<uint8_t> kMuch(size_t(64) << 20, 7);
const std::atomic<bool> kNever{false};

TcpPeer peer(const Listener& listener) {
  return TcpPeer({"127.0.0.1", listener.port()});
}

template <class F>
double seconds_of(F&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

TEST_CASE("addresses are host:port, and those of IPv6 stand in brackets") {
  CHECK(TcpAddress{"127.0.0.1", 80}.text() == "127.0.0.1:80");
  CHECK(TcpAddress{"::1", 80}.text() == "[::1]:80");
  const auto is_split = [](const std::string& text, const std::string& host,
                           const std::optional<std::string>& port) {
    const auto parts = split_address(text);
    return parts && parts->host == host && parts->port == port;
  };
  CHECK(is_split("127.0.0.1:80", "127.0.0.1", "80"));
  CHECK(is_split("[::1]:80", "::1", "80"));
  CHECK(is_split("[::1]", "::1", std::nullopt));
  CHECK(is_split("here", "here", std::nullopt));
  CHECK(is_split("here:", "here", ""));
  for (const char* text : {"", ":80", "[]", "[::1", "[::1]x:80"}) {
    CAPTURE(text);
    CHECK(!split_address(text));
  }
}

TEST_CASE("a host that does not exist, and a port without a listener, are errors with a reason") {
  CHECK_THROWS_AS(TcpPeer({"no host", 80}), std::runtime_error);
  const uint16_t port = silent_port();
  const std::string refused = "127.0.0.1:" + std::to_string(port) + ": Connection refused";
  CHECK_THROWS_WITH(TcpConnection(TcpPeer({"127.0.0.1", port}), 1), refused.c_str());
}

TEST_CASE("all bytes arrive, however many") {
  Listener listener(Listener::Manner::reads);
  TcpConnection(peer(listener), 1).send(kMuch, 10, kNever);
  CHECK(listener.received() == std::string(kMuch.begin(), kMuch.end()));
}

TEST_CASE("whoever takes nothing is given up after the time that was said") {
  Listener listener(Listener::Manner::never_reads);
  TcpConnection connection(peer(listener), 1);
  const double seconds = seconds_of(
      [&] { CHECK_THROWS_WITH(connection.send(kMuch, 0.3, kNever), "Connection timed out"); });
  CHECK(seconds >= 0.3);
  CHECK(seconds < 5);
}

TEST_CASE("sending ends when it is cancelled, and when the peer goes away") {
  Listener deaf(Listener::Manner::never_reads);
  const std::atomic<bool> cancelled{true};
  const double seconds = seconds_of([&] {
    CHECK_THROWS_AS(TcpConnection(peer(deaf), 1).send(kMuch, 60, cancelled), std::runtime_error);
  });
  CHECK(seconds < 10);
  // Without a signal, which would end the tests.
  Listener gone(Listener::Manner::closes);
  CHECK_THROWS_AS(TcpConnection(peer(gone), 1).send(kMuch, 60, kNever), std::runtime_error);
}
