#include "mesh/mtl.h"

#include <charconv>
#include <cmath>
#include <limits>

#include "base/diagnostics.h"
#include "mesh/words.h"

namespace duet {

namespace {

constexpr std::string_view kWhiteSpace = " \t\r\f\v";

std::string_view trimmed(std::string_view text) {
  const size_t first = text.find_first_not_of(kWhiteSpace);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(kWhiteSpace) - first + 1);
}

std::string_view next_word(std::string_view& text) {
  return take_word(text, [](char c) { return kWhiteSpace.find(c) != kWhiteSpace.npos; });
}

class MtlReader {
 public:
  MtlReader(std::string_view text, const std::string& file) : rest_(text), file_(file) {}

  std::vector<MtlMaterial> read() {
    if (rest_.find('\0') != rest_.npos) fail("not a text file");
    if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);
    while (next_line()) {
      std::string_view words = text_;
      const std::string keyword(next_word(words));
      if (keyword == "newmtl")
        begin(trimmed(words));
      else if (keyword == "Kd" || keyword == "Ks")
        (keyword == "Kd" ? current().diffuse : current().specular) = color(keyword, words);
      else if (keyword == "map_Kd" || keyword == "map_Ks")
        (keyword == "map_Kd" ? current().diffuse : current().specular) = image(keyword, words);
      else if (keyword == "Ns")
        current().exponent = number(keyword, words);
      else if (keyword == "d")
        set_opacity(number(keyword, words));
      else if (keyword == "map_d")
        current().opacity = image(keyword, words);
      else if (keyword == "bump")
        current().bump = image(keyword, words);
      else if (keyword == "illum")
        current().illum = model(words);
    }
    return std::move(materials_);
  }

 private:
  template <class... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> text, Args&&... args) const {
    throw ReadError(
        fmt::format("{}:{}: {}", file_, line_, fmt::format(text, std::forward<Args>(args)...)));
  }

  /// Puts the next line with those that continue it into text_.
  bool next_line() {
    if (rest_.empty()) return false;
    text_.clear();
    line_ = next_;
    for (bool more = true; more && !rest_.empty(); ++next_) {
      const size_t end = std::min(rest_.find('\n'), rest_.size());
      std::string_view part = trimmed(rest_.substr(0, end));
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      more = part.ends_with('\\');
      if (more) part.remove_suffix(1);
      text_ += part;
      if (more) text_ += ' ';
    }
    return true;
  }

  void begin(std::string_view name) {
    if (name.empty()) fail("newmtl needs a name");
    materials_.emplace_back().name = name;
    materials_.back().line = line_;
  }
  MtlMaterial& current() {
    if (materials_.empty()) fail("no material has begun: newmtl is missing");
    return materials_.back();
  }

  static std::string shown(std::string_view word) {
    return fmt::format("\"{}\"{}", word.substr(0, 32), word.size() > 32 ? "…" : "");
  }

  double next_number(const std::string& keyword, std::string_view word) const {
    if (word.empty()) fail("{} needs a number", keyword);
    if (word.size() > 1 && word[0] == '+') word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    // Numbers too small for double precision are no use either.
    if (error != std::errc() || end != word.data() + word.size() ||
        !(std::abs(value) <= double(std::numeric_limits<float>::max())))
      fail("{} is not a number ({})", shown(word), keyword);
    return value;
  }

  MtlMaterial::Value number(const std::string& keyword, std::string_view words) const {
    const double value = next_number(keyword, next_word(words));
    return {{value, value, value}, "", line_};
  }

  /// Three numbers, or one for a grey.
  MtlMaterial::Value color(const std::string& keyword, std::string_view words) const {
    MtlMaterial::Value value = number(keyword, next_word(words));
    const std::string_view second = next_word(words);
    if (second.empty() || second[0] == '#') return value;
    value.numbers[1] = next_number(keyword, second);
    value.numbers[2] = next_number(keyword, next_word(words));
    return value;
  }

  MtlMaterial::Value image(const std::string& keyword, std::string_view words) const {
    const std::string_view name = next_word(words);
    if (name.empty()) fail("{} needs the name of an image", keyword);
    return {{}, std::string(name), line_};
  }

  void set_opacity(const MtlMaterial::Value& value) {
    if (!(value.numbers[0] >= 0 && value.numbers[0] <= 1))
      fail("an opacity is from 0 to 1, not {}", value.numbers[0]);
    current().opacity = value.numbers[0] == 1 ? MtlMaterial::Value{} : value;
  }

  int model(std::string_view words) const {
    const double value = next_number("illum", next_word(words));
    if (value != std::floor(value) || std::abs(value) > 1000)
      fail("{} is not an illumination model", value);
    return int(value);
  }

  std::string_view rest_;
  const std::string& file_;
  std::string text_;
  int line_ = 1, next_ = 1;  ///< of text_, and of what follows it
  std::vector<MtlMaterial> materials_;
};

}  // namespace

std::vector<MtlMaterial> parse_mtl(std::string_view text, const std::string& file) {
  return MtlReader(text, file).read();
}

}  // namespace duet
