#include "evaluate/report/version.h"

#include <fmt/format.h>
#include <tbb/version.h>
#include <zlib.h>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include "geometry/accel.h"
#include "image/library_versions.h"

namespace duet {

namespace {

#if defined(__clang__)
constexpr const char* kCompiler = "clang " __clang_version__;
#else
constexpr const char* kCompiler = "g++ " __VERSION__;
#endif

/// The level of x86-64 that the machine has, of which loops over numbers make use.
const char* instruction_set() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw"))
    return "x86-64 with AVX-512";
  if (__builtin_cpu_supports("avx2")) return "x86-64 with AVX2";
  return "x86-64";
#elif defined(__aarch64__)
  return "arm64";
#else
  return "unknown";
#endif
}

/// "2.1.3" of 20103, where each part but the first has `digits` digits.
std::string version_of(int number, int unit) {
  return fmt::format("{}.{}.{}", number / (unit * unit), number / unit % unit, number % unit);
}

}  // namespace

std::vector<Version> versions() {
  return {
      {"duet", DUET_VERSION},
      {"compiler", kCompiler},
      {"processor", instruction_set()},
      {"Embree", embree_version()},
      {"oneTBB", TBB_runtime_version()},
      {"OpenEXR", openexr_version()},
      {"OpenImageIO", openimageio_version()},
      {"pugixml", fmt::format("{}.{}", PUGIXML_VERSION / 1000, PUGIXML_VERSION / 10 % 100)},
      {"fmt", version_of(FMT_VERSION, 100)},
      {"zlib", zlibVersion()},
      {"nlohmann-json", fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR,
                                    NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
  };
}

}  // namespace duet
