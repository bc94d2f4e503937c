// Objects that threads use one after the other.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

namespace duet {

/// Keeps objects that no thread uses, so that each thread at work has one of its own.
template <class T>
class ObjectPool {
 public:
  /// One that was given back, or what `make` makes.
  template <class F>
  std::unique_ptr<T> take(const F& make) {
    {
      const std::lock_guard lock(mutex_);
      if (!idle_.empty()) {
        auto object = std::move(idle_.back());
        idle_.pop_back();
        return object;
      }
    }
    return make();
  }
  void give_back(std::unique_ptr<T> object) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(object));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> idle_;
};

}  // namespace duet
