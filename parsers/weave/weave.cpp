#include "weave/weave.h"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/diagnostics.h"

namespace duet {

namespace {

/// A tile of more cells than this is a mistake: real ones have some hundred.
constexpr double kMostCells = 1 << 20;

class Parser {
 public:
  Parser(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  Weave run() {
    if (word() != "weave") fail("a description of a weave begins with \"weave {\"");
    block([&](const std::string& name) {
      if (name == "pattern")
        pattern();
      else if (name == "yarn")
        yarn();
      else if (expect('='); name == "tileWidth")
        width_ = side();
      else if (name == "tileHeight")
        height_ = side();
      else
        value();
    });
    skip();
    if (at_ < text_.size()) fail("there is more after the end of the weave");
    check();
    return std::move(weave_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw ReadError(fmt::format("{}:{}: {}", file_, line_, message));
  }

  void advance() { line_ += text_[at_++] == '\n'; }
  bool follows(std::string_view s) const { return text_.substr(at_, s.size()) == s; }

  /// White space and comments.
  void skip() {
    for (;;) {
      while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) advance();
      if (follows("//")) {
        while (at_ < text_.size() && text_[at_] != '\n') advance();
      } else if (follows("/*")) {
        while (at_ < text_.size() && !follows("*/")) advance();
        if (at_ == text_.size()) fail("a comment has no end");
        at_ += 2;
      } else {
        return;
      }
    }
  }

  bool accept(char c) {
    skip();
    if (at_ == text_.size() || text_[at_] != c) return false;
    advance();
    return true;
  }
  void expect(char c) {
    if (!accept(c)) fail(fmt::format("\"{}\" is missing", c));
  }

  std::string word() {
    skip();
    const size_t from = at_;
    while (at_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_'))
      ++at_;
    if (at_ == from) fail("a name is missing");
    return std::string(text_.substr(from, at_ - from));
  }

  double number() {
    skip();
    double v = 0;
    const char* const from = text_.data() + at_;
    const auto [end, error] = std::from_chars(from, text_.data() + text_.size(), v);
    if (error != std::errc() || !std::isfinite(v)) fail("a number is missing");
    at_ += size_t(end - from);
    return v;
  }

  /// A whole number from 1 on; `rule` says so.
  double count(const char* rule) {
    const double n = number();
    if (!(n >= 1 && n <= kMostCells && n == std::floor(n))) fail(rule);
    return n;
  }
  double side() { return count("the sides of a tile are whole numbers from 1 on"); }

  /// `{ entry, entry, … }`; commas may be left out or be too many.
  template <class Entry>
  void block(const Entry& entry) {
    expect('{');
    while (!accept('}'))
      if (!accept(',')) entry(word());
  }

  /// A value of which nothing is kept.
  void value() {
    skip();
    if (accept('"')) {
      while (at_ < text_.size() && text_[at_] != '"') advance();
      expect('"');
    } else if (at_ < text_.size() && (text_[at_] == '{' || text_[at_] == '$')) {
      color();
    } else if (at_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[at_]))) {
      word();
    } else {
      number();
    }
  }

  WeaveColor color() {
    WeaveColor c;
    if (accept('$')) {
      c.parameter = word();
    } else if (accept('{')) {
      for (int i = 0; i < 3; ++i) {
        if (i > 0) expect(',');
        c.value[i] = float(number());
      }
      expect('}');
    } else {
      c.value = Spectrum(float(number()));
    }
    if (!(std::min({c.value.r, c.value.g, c.value.b}) >= 0 && std::isfinite(c.value.max())))
      fail("a colour has a negative component or one that is too large");
    return c;
  }

  void pattern() {
    expect('{');
    while (!accept('}')) {
      const double n = count("the cells of a pattern are numbers of yarns, from 1 on");
      weave_.pattern.push_back(uint32_t(n) - 1);
      accept(',');
    }
  }

  void yarn() {
    Yarn y;
    block([&](const std::string& name) {
      expect('=');
      if (name == "kd")
        y.diffuse = color();
      else if (name == "ks")
        y.specular = color();
      else
        value();
    });
    weave_.yarns.push_back(std::move(y));
  }

  void check() const {
    if (!width_ || !height_) fail("the weave has no \"tileWidth\" or no \"tileHeight\"");
    if (double(weave_.pattern.size()) != *width_ * *height_)
      fail(fmt::format("the pattern has {} cells, but a tile of {} x {}", weave_.pattern.size(),
                       *width_, *height_));
    for (const uint32_t y : weave_.pattern)
      if (y >= weave_.yarns.size())
        fail(fmt::format("the pattern names yarn {} of {}", y + 1, weave_.yarns.size()));
  }

  std::string_view text_;
  const std::string& file_;
  size_t at_ = 0;
  int line_ = 1;
  std::optional<double> width_, height_;
  Weave weave_;
};

}  // namespace

Weave parse_weave(std::string_view text, const std::string& file) {
  return Parser(text, file).run();
}

std::vector<float> Weave::shares() const {
  std::vector<size_t> cells(yarns.size());
  for (const uint32_t yarn : pattern) ++cells[yarn];
  std::vector<float> shares;
  for (const size_t count : cells) shares.push_back(float(double(count) / double(pattern.size())));
  return shares;
}

}  // namespace duet
