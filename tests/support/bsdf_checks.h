// What the tests of materials have in common: comparing numbers, and going through Mitsuba's table.
#pragma once

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "support/test_material.h"

namespace duet::test {

inline constexpr Transport kTransports[] = {Transport::radiance, Transport::importance};

inline const char* name(Transport t) {
  return t == Transport::radiance ? "radiance" : "importance";
}

/// The other end's transport.
inline Transport opposite(Transport t) {
  return t == Transport::radiance ? Transport::importance : Transport::radiance;
}

/// Equal up to a relative error, or up to 1e-6.
inline bool close(double a, double b, double relative) {
  return std::abs(a - b) <= relative * std::abs(b) + 1e-6;
}
inline bool close(const Spectrum& a, const Spectrum& b, double relative) {
  return close(double(a.r), double(b.r), relative) && close(double(a.g), double(b.g), relative) &&
         close(double(a.b), double(b.b), relative);
}

inline std::string text(const Spectrum& s) {
  return fmt::format("({}, {}, {})", s.r, s.g, s.b);
}
inline std::string text(const Vector3f& v) {
  return fmt::format("({}, {}, {})", v.x, v.y, v.z);
}

/// The descriptions in Mitsuba's table: each model with each of its parameters.
inline const nlohmann::json& mitsuba_cases() {
  return mitsuba_tables()["cases"];
}

/// Calls f(row, wo, wi) for the direction pairs of a case.
template <class F>
void for_each_pair(const nlohmann::json& c, const F& f) {
  size_t row = 0;
  for (const auto& set : c["pairs"])
    for (const auto& pair : mitsuba_tables()["pairs"][set.get<std::string>()])
      f(row++, to_vector(pair[0]), to_vector(pair[1]));
}

/// Whether the description or one nested in it has a key with this value, or of this name at all.
inline bool mentions(const nlohmann::json& bsdf, const char* key,
                     const nlohmann::json& value = {}) {
  if (bsdf.contains(key) && (value.is_null() || bsdf[key] == value)) return true;
  if (bsdf.contains("nested"))
    for (const auto& n : bsdf["nested"])
      if (mentions(n, key, value)) return true;
  return false;
}

/// Whether there is a bump or normal map in the description.
inline bool perturbs(const nlohmann::json& bsdf) {
  return mentions(bsdf, "type", "normalmap") || mentions(bsdf, "type", "bumpmap");
}

/// Reports the first failure of each case and how many there are.
class Failures {
 public:
  explicit Failures(const std::string& name) : name_(name) {}
  ~Failures() { CHECK_MESSAGE(count_ == 0, name_, ": ", count_, " failures, first ", first_); }
  void add(const std::string& what) {
    if (count_++ == 0) first_ = what;
  }

 private:
  std::string name_, first_;
  int count_ = 0;
};

}  // namespace duet::test
