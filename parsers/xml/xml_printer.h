// Prints the elements of a scene file.
#pragma once

#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "math/spectrum.h"
#include "math/transform.h"

namespace duet {

class XmlPrinter {
 public:
  /// Opens <tag type="…" name="…" id="…">; empty attributes are left out.
  void open(std::string_view tag, std::string_view type, std::string_view name = {},
            std::string_view id = {}) {
    line(fmt::format("<{}{}{}{}>", tag, attribute("type", type), attribute("name", name),
                     attribute("id", id)));
    tags_.emplace_back(tag);
    opened_ = text_.size();
  }
  void close() {
    const std::string tag = std::move(tags_.back());
    tags_.pop_back();
    if (text_.size() == opened_) {  // nothing in it: <tag/>
      text_.replace(text_.size() - 2, 2, "/>\n");
      return;
    }
    line(fmt::format("</{}>", tag));
  }

  void boolean(std::string_view name, bool value) {
    this->value("boolean", name, value ? "true" : "false");
  }
  void integer(std::string_view name, long long value) {
    this->value("integer", name, fmt::format("{}", value));
  }
  template <class T>  // float or double: as many digits as it has
  void number(std::string_view name, T value) {
    this->value("float", name, fmt::format("{}", value));
  }
  void point(std::string_view name, const std::array<double, 3>& p) {
    value("point", name, fmt::format("{} {} {}", p[0], p[1], p[2]));
  }
  void string(std::string_view name, std::string_view value) { this->value("string", name, value); }
  void rgb(std::string_view name, const Spectrum& s) {
    value("rgb", name, fmt::format("{} {} {}", s.r, s.g, s.b));
  }
  void rgb(std::string_view name, const std::array<double, 3>& c) {
    value("rgb", name, fmt::format("{} {} {}", c[0], c[1], c[2]));
  }
  void reference(std::string_view name, std::string_view id) {
    line(fmt::format("<ref{}{}/>", attribute("name", name), attribute("id", id)));
  }
  /// Nothing for the identity, which is what holds without a transform.
  void transform(std::string_view name, const Matrix4& m) {
    if (m != Matrix4{}) matrix(name, m);
  }
  void matrix(std::string_view name, const Matrix4& m) {
    std::string numbers;
    for (int i = 0; i < 4; ++i)
      for (double v : m[i]) numbers += fmt::format("{}{}", numbers.empty() ? "" : " ", v);
    line(fmt::format("<transform{}>", attribute("name", name)));
    line(fmt::format("  <matrix value=\"{}\"/>", numbers));
    line("</transform>");
  }
  void line(std::string_view text) {
    text_.append(2 * (tags_.size() + 1), ' ');
    text_ += text;
    text_ += '\n';
    ++lines_;
  }

  const std::string& text() const { return text_; }
  int lines() const { return lines_; }

  /// A value as an attribute has it, on one line: `$` is no parameter, and white space, which
  /// would become plain spaces, stays as it is.
  static std::string escaped(std::string_view value) {
    std::string s;
    for (char c : value) switch (c) {
        case '&':
          s += "&amp;";
          break;
        case '<':
          s += "&lt;";
          break;
        case '"':
          s += "&quot;";
          break;
        case '$':
          s += "\\$";
          break;
        case '\n':
        case '\r':
        case '\t':
          s += fmt::format("&#{};", int(c));
          break;
        default:
          s += c;
      }
    return s;
  }

 private:
  static std::string attribute(std::string_view name, std::string_view value) {
    return value.empty() ? "" : fmt::format(" {}=\"{}\"", name, escaped(value));
  }
  void value(std::string_view tag, std::string_view name, std::string_view value) {
    line(fmt::format("<{}{} value=\"{}\"/>", tag, attribute("name", name), escaped(value)));
  }

  std::string text_;
  int lines_ = 0;
  std::vector<std::string> tags_;  ///< that are open
  size_t opened_ = 0;              ///< end of the text after the last opening tag
};

}  // namespace duet
