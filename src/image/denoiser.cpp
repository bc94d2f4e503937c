#include "image/denoiser.h"

#include <fmt/format.h>

#include <stdexcept>

namespace duet {

namespace {

// Numbers of Open Image Denoise's interface.
constexpr int kCpu = 1;
constexpr int kThreeFloats = 3;

}  // namespace

Denoiser::Denoiser(int threads) : oidn_(load_denoiser_library()), device_(oidn_.new_device(kCpu)) {
  check();
  if (!device_) throw std::runtime_error("Open Image Denoise cannot work on this processor");
  oidn_.set_device_int(device_.get(), "numThreads", threads);
  // Its threads are those of the whole program, which are bound to no core.
  oidn_.set_device_bool(device_.get(), "setAffinity", false);
  oidn_.commit_device(device_.get());
  check();
  const int version = oidn_.get_device_int(device_.get(), "version");
  name_ = fmt::format("Open Image Denoise {}.{}.{}", version / 10000, version / 100 % 100,
                      version % 100);
}

void Denoiser::check() const {
  const char* message = nullptr;
  if (oidn_.get_device_error(device_.get(), &message) != 0)
    throw std::runtime_error(
        fmt::format("Open Image Denoise: {}", message ? message : "an error without a message"));
}

Denoiser::Filter Denoiser::new_filter() const {
  Filter filter(oidn_.new_filter(device_.get(), "RT"));
  check();
  return filter;
}

void Denoiser::run(const Filter& filter) const {
  oidn_.commit_filter(filter.get());
  check();
  oidn_.execute_filter(filter.get());
  check();
}

void Denoiser::set(const Filter& filter, const char* name, const DenoiserGuides& size,
                   std::vector<float>& pixels) const {
  oidn_.set_filter_image(filter.get(), name, pixels.data(), kThreeFloats, size_t(size.width),
                         size_t(size.height), 0, 0, 0);
}

DenoiserGuides Denoiser::clean(DenoiserGuides noisy) const {
  for (const auto& [name, pixels] :
       {std::pair{"albedo", &noisy.albedo}, std::pair{"normal", &noisy.normal}}) {
    const Filter filter = new_filter();
    set(filter, name, noisy, *pixels);
    set(filter, "output", noisy, *pixels);
    run(filter);
  }
  return noisy;
}

std::vector<float> Denoiser::denoise(DenoiserGuides& clean, std::vector<float> colours) const {
  const Filter filter = new_filter();
  set(filter, "color", clean, colours);
  set(filter, "albedo", clean, clean.albedo);
  set(filter, "normal", clean, clean.normal);
  set(filter, "output", clean, colours);
  oidn_.set_filter_bool(filter.get(), "hdr", true);
  oidn_.set_filter_bool(filter.get(), "cleanAux", true);
  run(filter);
  return colours;
}

}  // namespace duet
