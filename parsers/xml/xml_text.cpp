#include "xml/xml_text.h"

#include <algorithm>

#include "values/text.h"

namespace duet {

namespace {

void append_code_point(std::string& out, uint32_t c) {
  const auto rest = [&](int shift) { out += char(0x80 | ((c >> shift) & 0x3f)); };
  if (c < 0x80) {
    out += char(c);
  } else if (c < 0x800) {
    out += char(0xc0 | (c >> 6)), rest(0);
  } else if (c < 0x10000) {
    out += char(0xe0 | (c >> 12)), rest(6), rest(0);
  } else {
    out += char(0xf0 | (c >> 18)), rest(12), rest(6), rest(0);
  }
}

std::optional<std::string> from_utf16(std::string_view text, bool little_endian) {
  if (text.size() % 2 != 0) return std::nullopt;
  const auto unit = [&](size_t i) {
    const auto first = uint8_t(text[2 * i]), second = uint8_t(text[2 * i + 1]);
    return little_endian ? uint32_t(second) << 8 | first : uint32_t(first) << 8 | second;
  };
  std::string out;
  for (size_t i = 0; i < text.size() / 2; ++i) {
    uint32_t c = unit(i);
    if (c >= 0xd800 && c < 0xe000) {
      // Two units make one character beyond the first 65536.
      if (c >= 0xdc00 || i + 1 >= text.size() / 2) return std::nullopt;
      const uint32_t low = unit(++i);
      if (low < 0xdc00 || low >= 0xe000) return std::nullopt;
      c = 0x10000 + ((c - 0xd800) << 10) + (low - 0xdc00);
    }
    append_code_point(out, c);
  }
  return out;
}

/// The encoding that the declaration names, in lower case.
std::string declared_encoding(std::string_view text) {
  if (!text.starts_with("<?xml")) return "";
  const std::string_view declaration = text.substr(0, text.find("?>"));
  const size_t name = declaration.find("encoding");
  if (name == text.npos) return "";
  const size_t open = declaration.find_first_of("'\"", name);
  if (open == text.npos) return "";
  const size_t close = declaration.find(declaration[open], open + 1);
  if (close == text.npos) return "";
  return to_lower(declaration.substr(open + 1, close - open - 1));
}

}  // namespace

std::optional<std::string> to_utf8(std::string text) {
  const std::string_view t = text;
  std::optional<std::string> utf8;
  if (t.starts_with("\xff\xfe")) {
    utf8 = from_utf16(t.substr(2), true);
  } else if (t.starts_with("\xfe\xff")) {
    utf8 = from_utf16(t.substr(2), false);
  } else if (t.starts_with(std::string_view("<\0", 2))) {
    utf8 = from_utf16(t, true);
  } else if (t.starts_with(std::string_view("\0<", 2))) {
    utf8 = from_utf16(t, false);
  } else if (const std::string name = declared_encoding(t);
             name == "iso-8859-1" || name == "latin1") {
    utf8.emplace();
    for (const char c : t) append_code_point(*utf8, uint8_t(c));
  } else {
    utf8 = std::move(text);
    if (utf8->starts_with("\xef\xbb\xbf")) utf8->erase(0, 3);
  }
  if (utf8) utf8->resize(utf8->find_last_not_of('\0') + 1);
  return utf8;
}

XmlText::Source XmlText::make_source(const std::string& text,
                                     std::shared_ptr<const std::string> file) {
  Source source{std::move(file), {0}, {}};
  for (size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n') source.line_starts.push_back(i + 1);
  return source;
}

XmlText::XmlText(std::string text, std::shared_ptr<const std::string> file, PlaceOfLine place)
    : text_(std::move(text)) {
  sources_.push_back(make_source(text_, std::move(file)));
  sources_.back().place = std::move(place);
  pieces_.push_back({0, 0, 0});
}

SourceLocation XmlText::at(size_t offset) const {
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), offset,
                                      [](size_t o, const Piece& p) { return o < p.begin; });
  const Piece& piece = after == pieces_.begin() ? pieces_.front() : *(after - 1);
  const Source& source = sources_[piece.source];
  const size_t place = piece.source_begin + (offset - piece.begin);
  const auto& starts = source.line_starts;
  const size_t line =
      size_t(std::upper_bound(starts.begin(), starts.end(), place) - starts.begin());
  if (auto named = source.place ? source.place(int(line)) : nullptr)
    return {std::move(named), 0, 0};
  return {source.file, int(line), int(place - starts[line - 1]) + 1};
}

}  // namespace duet
