// A program that others connect to by TCP, and that behaves as it is told.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

namespace duet::test {

/// Listens at a free port of the loopback interface and takes one connection after the other.
class Listener {
 public:
  enum class Manner {
    reads,
    never_reads,  ///< connections stay open, and nothing is taken from them
    closes,       ///< each connection after its first bytes
  };
  /// Throws std::system_error.
  explicit Listener(Manner manner);
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  uint16_t port() const { return port_; }
  /// How many have connected.
  int connections() const { return connections_; }
  /// All that came, once the last connection has ended or, if it does not, after some seconds.
  std::string received();

 private:
  void work();
  void serve(int connection);

  const Manner manner_;
  uint16_t port_ = 0;
  int socket_ = -1;
  std::atomic<bool> ends_{false};
  std::atomic<int> connections_{0}, open_{0};
  std::mutex mutex_;
  std::string bytes_;
  std::thread thread_;
};

/// A port of the loopback interface at which nobody listens.
uint16_t silent_port();

}  // namespace duet::test
