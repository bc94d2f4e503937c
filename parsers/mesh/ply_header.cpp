#include "mesh/ply_header.h"

#include <algorithm>
#include <charconv>
#include <optional>

namespace duet {

namespace {

struct TypeRow {
  const char* name;
  PlyType type;
};
constexpr TypeRow kTypes[] = {
    {"char", PlyType::int8},       {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},     {"short", PlyType::int16},     {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},   {"uint16", PlyType::uint16},   {"int", PlyType::int32},
    {"int32", PlyType::int32},     {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
    {"long", PlyType::int64},      {"int64", PlyType::int64},     {"ulong", PlyType::uint64},
    {"uint64", PlyType::uint64},   {"half", PlyType::float16},    {"float16", PlyType::float16},
    {"float", PlyType::float32},   {"float32", PlyType::float32}, {"double", PlyType::float64},
    {"float64", PlyType::float64},
};

std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words;
  constexpr std::string_view kSpace = " \t\r\v\f";
  for (size_t begin = line.find_first_not_of(kSpace); begin < line.size();) {
    const size_t end = std::min(line.find_first_of(kSpace, begin), line.size());
    words.emplace_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kSpace, end);
  }
  return words;
}

PlyType parse_type(const ByteReader& in, const std::string& name) {
  for (const TypeRow& row : kTypes)
    if (name == row.name) return row.type;
  std::vector<std::string> known;
  for (const TypeRow& row : kTypes) known.push_back(row.name);
  in.fail("unknown type \"{}\"{}", name, did_you_mean(name, known));
}

PlyFormat parse_format(const ByteReader& in, const std::vector<std::string>& words) {
  if (words.size() != 3 || words[2] != "1.0") in.fail("the format is not one of PLY 1.0");
  if (words[1] == "ascii") return PlyFormat::ascii;
  if (words[1] == "binary_little_endian") return PlyFormat::little_endian;
  if (words[1] == "binary_big_endian") return PlyFormat::big_endian;
  in.fail("unknown format \"{}\"", words[1]);
}

PlyElement parse_element(const ByteReader& in, const std::vector<std::string>& words) {
  PlyElement element;
  if (words.size() != 3) in.fail("an element needs a name and a number");
  element.name = words[1];
  const std::string& count = words[2];
  const auto [end, error] =
      std::from_chars(count.data(), count.data() + count.size(), element.count);
  if (error != std::errc() || end != count.data() + count.size())
    in.fail("\"{}\" is not a number of elements", count);
  return element;
}

PlyProperty parse_property(const ByteReader& in, const std::vector<std::string>& words) {
  PlyProperty property;
  property.is_list = words.size() > 1 && words[1] == "list";
  if (words.size() != (property.is_list ? 5 : 3)) in.fail("a property needs a type and a name");
  property.name = words.back();
  property.type = parse_type(in, words[words.size() - 2]);
  if (property.is_list) {
    property.count_type = parse_type(in, words[2]);
    if (!is_integer(property.count_type)) in.fail("a list cannot have {} elements", words[2]);
  }
  return property;
}

}  // namespace

size_t size_in_bytes(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
    case PlyType::float16:
      return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
      return 4;
    case PlyType::int64:
    case PlyType::uint64:
    case PlyType::float64:
      return 8;
  }
  return 0;
}

bool is_integer(PlyType type) {
  return type != PlyType::float16 && type != PlyType::float32 && type != PlyType::float64;
}

int PlyElement::find(const std::string& property) const {
  for (size_t i = 0; i < properties.size(); ++i)
    if (properties[i].name == property && !properties[i].is_list) return int(i);
  return -1;
}

uint64_t PlyElement::least_bytes(PlyFormat format) const {
  // In text, a number takes a digit and a separator; the file's last separator may be missing.
  if (format == PlyFormat::ascii) return 2 * properties.size();
  uint64_t bytes = 0;
  for (const PlyProperty& p : properties) bytes += size_in_bytes(p.is_list ? p.count_type : p.type);
  return bytes;
}

PlyHeader read_ply_header(ByteReader& in) {
  PlyHeader header;
  std::optional<PlyFormat> format;
  std::string_view line;
  if (!in.next_line(line) || line != "ply") in.fail("not a PLY file");
  for (;;) {
    if (!in.next_line(line)) in.fail("the header does not end");
    const std::vector<std::string> words = words_of(line);
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "end_header") break;
    if (words[0] == "format") {
      if (format) in.fail("the format is given twice");
      format = parse_format(in, words);
    } else if (words[0] == "element") {
      header.elements.push_back(parse_element(in, words));
    } else if (words[0] == "property") {
      if (header.elements.empty()) in.fail("the property belongs to no element");
      header.elements.back().properties.push_back(parse_property(in, words));
    } else {
      in.fail("\"{}\" is not understood", words[0]);
    }
  }
  if (!format) in.fail("the header states no format");
  header.format = *format;
  uint64_t left = in.remaining() + (header.format == PlyFormat::ascii);
  for (const PlyElement& e : header.elements) {
    const uint64_t least = e.least_bytes(header.format);
    if (least > 0 && e.count > left / least)
      in.fail("the file is too short for {} elements \"{}\"", e.count, e.name);
    left -= e.count * least;
  }
  return header;
}

}  // namespace duet
