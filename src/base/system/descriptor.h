// Numbers that the system gives to what is open.
#pragma once

#include <utility>

namespace duet {

/// A descriptor of a file or a socket, which is closed when this goes away.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  /// Negative if there is none.
  int number() const { return number_; }
  void close();

 private:
  int number_;
};

}  // namespace duet
