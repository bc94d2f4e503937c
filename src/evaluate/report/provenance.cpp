#include "evaluate/report/provenance.h"

#include <fmt/chrono.h>

#include <charconv>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <optional>

namespace duet {

namespace fs = std::filesystem;

namespace {

std::optional<std::time_t> source_date_epoch() {
  const char* text = std::getenv("SOURCE_DATE_EPOCH");
  if (!text) return std::nullopt;
  // Years of four digits.
  constexpr long long kLast = 253402300799;
  long long seconds = 0;
  const char* end = text + std::strlen(text);
  const auto [rest, error] = std::from_chars(text, end, seconds);
  if (error != std::errc() || rest != end || seconds < 0 || seconds > kLast) return std::nullopt;
  return std::time_t(seconds);
}

std::string without_folders(const fs::path& path) {
  std::error_code error;
  const fs::path here = fs::current_path(error);
  if (!error) {
    const fs::path below = path.lexically_normal().lexically_relative(here);
    if (!below.empty() && *below.begin() != ".." && below != ".") return below.string();
  }
  const fs::path last = path.has_filename() ? path.filename() : path.parent_path().filename();
  return last.string();
}

}  // namespace

std::string host_free(const std::string& argument) {
  size_t start = 0;
  if (const size_t equals = argument.find('=');
      equals != std::string::npos && equals + 1 < argument.size() && argument[equals + 1] == '/')
    start = equals + 1;
  else if (argument.size() > 2 && argument[0] == '-' && argument[1] != '-' && argument[2] == '/')
    start = 2;
  if (start >= argument.size() || argument[start] != '/') return argument;
  return argument.substr(0, start) + without_folders(argument.substr(start));
}

std::vector<std::string> host_free(std::vector<std::string> arguments) {
  for (std::string& a : arguments) a = host_free(a);
  return arguments;
}

bool is_reproducible() {
  return source_date_epoch().has_value();
}

std::string image_date() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
                     fmt::gmtime(source_date_epoch().value_or(std::time(nullptr))));
}

}  // namespace duet
