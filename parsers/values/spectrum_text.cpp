#include "values/spectrum_text.h"

#include <algorithm>

#include "base/diagnostics.h"
#include "values/text.h"

namespace duet {

std::optional<std::array<double, 3>> parse_hex_color(std::string_view text) {
  text = trim(text);
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  std::array<double, 3> color{};
  for (int i = 0; i < 6; ++i) {
    const char ch = text[size_t(i) + 1];
    const int digit = ch >= '0' && ch <= '9'   ? ch - '0'
                      : ch >= 'a' && ch <= 'f' ? ch - 'a' + 10
                      : ch >= 'A' && ch <= 'F' ? ch - 'A' + 10
                                               : -1;
    if (digit < 0) return std::nullopt;
    color[size_t(i) / 2] += (i % 2 ? 1 : 16) * digit / 255.0;
  }
  return color;
}

size_t first_not_increasing(std::span<const SpectrumSample> samples) {
  for (size_t i = 1; i < samples.size(); ++i)
    if (!(samples[i - 1].wavelength < samples[i].wavelength)) return i;
  return 0;
}

std::vector<SpectrumSample> parse_spectrum_lines(std::string_view text, const std::string& file) {
  std::vector<SpectrumSample> samples;
  int line_number = 0;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    ++line_number;
    line = line.substr(0, line.find('#'));
    if (trim(line).empty()) continue;
    const auto numbers = parse_numbers(line);
    if (!numbers || numbers->size() != 2)
      throw ReadError(
          fmt::format("{}: line {} is not a wavelength and a value", file, line_number));
    samples.push_back({(*numbers)[0], (*numbers)[1]});
  }
  return samples;
}

}  // namespace duet
