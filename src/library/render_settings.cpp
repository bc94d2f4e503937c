// What settings of renders have to be, whatever the scene.
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "base/failures.h"
#include "base/parallel.h"
#include "evaluate/report/render_limits.h"
#include "library/contents.h"

namespace duet {

namespace {

void check_budget(const RenderSettings& s) {
  if (s.spp && (*s.spp < 1 || *s.spp > kMaxSpp))
    throw std::invalid_argument(fmt::format(
        "{} samples per pixel: their number is a whole number from 1 to {}", *s.spp, kMaxSpp));
  // Written so that NaN is refused.
  if (s.seconds && !(*s.seconds > 0 && *s.seconds <= kMaxSeconds))
    throw std::invalid_argument(
        fmt::format("a render of {} seconds: time is a positive number of seconds, of at most {}",
                    *s.seconds, kMaxSeconds));
  if (s.target_error && !(*s.target_error > 0 && std::isfinite(*s.target_error)))
    throw std::invalid_argument(
        fmt::format("target_error: {} is not a positive number", *s.target_error));
}

void check_window(const RenderSettings& s) {
  if (s.size)
    for (const int side : *s.size)
      if (side < 1 || side > kMaxImageSide)
        throw std::invalid_argument(fmt::format("size: {} × {} is not from 1 × 1 to {} × {}",
                                                (*s.size)[0], (*s.size)[1], kMaxImageSide,
                                                kMaxImageSide));
  if (!s.crop) return;
  const auto [x, y, width, height] = *s.crop;
  if (x < 0 || y < 0 || width < 1 || height < 1)
    throw std::invalid_argument(
        fmt::format("crop: a window of {} × {} pixels from ({}, {}) is empty or begins outside",
                    width, height, x, y));
}

}  // namespace

int threads_or_all(int threads) {
  if (threads < 0 || threads > kMaxThreads)
    throw std::invalid_argument(fmt::format(
        "threads: {} is not a number from 1 to {}, nor 0 for all", threads, kMaxThreads));
  if (threads > 0) return threads;
  try {
    static const HardwareThreads all;
    return all.count();
  } catch (const UsageError& e) {
    throw std::invalid_argument(e.what());
  }
}

void check_settings(const RenderSettings& settings) {
  check_budget(settings);
  check_window(settings);
}

}  // namespace duet
