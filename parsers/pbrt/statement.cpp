#include "pbrt/statement.h"

#include <stdexcept>

namespace duet::pbrt {

namespace {

const Row* find_row(std::string_view kind, std::string_view plugin) {
  static const std::vector<Row> rows = all_rows();
  for (const Row& r : rows)
    if (r.kind == kind && r.name == plugin && has_version(r.versions, Version::v4) &&
        r.status != Status::refused)
      return &r;
  throw std::logic_error(fmt::format("pbrt-v4 has no {} \"{}\"", kind, plugin));
}

}  // namespace

Statement::Statement(std::string_view kind, std::string_view plugin, std::string text)
    : row_(find_row(kind, plugin)), text_(std::move(text)) {}

Statement Statement::named(std::string_view directive, std::string_view kind, std::string_view name,
                           std::string_view plugin) {
  return {kind, plugin,
          fmt::format("{} {} \"string type\" {}", directive, quoted(name), quoted(plugin))};
}

Statement Statement::texture(std::string_view name, bool is_color, std::string_view plugin) {
  return {"Texture", plugin,
          fmt::format("Texture {} \"{}\" {}", quoted(name), is_color ? "spectrum" : "float",
                      quoted(plugin))};
}

std::string Statement::quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out += '"';
}

void Statement::begin(std::string_view name, Type type) {
  for (const std::span<const Spec> list : {row_->parameters, row_->more})
    for (const Spec& s : list)
      if (s.name == name && has_version(s.versions, Version::v4) && (s.types & of(type))) {
        text_ += fmt::format(" \"{} {}\" ", type_name(type), name);
        return;
      }
  throw std::logic_error(fmt::format("{} \"{}\" of pbrt-v4 has no \"{} {}\"", row_->kind,
                                     row_->name, type_name(type), name));
}

Statement& Statement::number(std::string_view name, double value) {
  begin(name, Type::number);
  text_ += fmt::format("{}", value);
  return *this;
}

Statement& Statement::integer(std::string_view name, int value) {
  begin(name, Type::integer);
  text_ += fmt::format("{}", value);
  return *this;
}

Statement& Statement::boolean(std::string_view name, bool value) {
  begin(name, Type::boolean);
  text_ += value ? "true" : "false";
  return *this;
}

Statement& Statement::string(std::string_view name, std::string_view value) {
  begin(name, Type::string);
  text_ += quoted(value);
  return *this;
}

Statement& Statement::strings(std::string_view name, const std::array<std::string, 2>& values) {
  begin(name, Type::string);
  text_ += fmt::format("[{} {}]", quoted(values[0]), quoted(values[1]));
  return *this;
}

Statement& Statement::color(std::string_view name, const Spectrum& value) {
  begin(name, Type::rgb);
  text_ += fmt::format("[{} {} {}]", value.r, value.g, value.b);
  return *this;
}

Statement& Statement::refer(std::string_view name, std::string_view texture) {
  begin(name, Type::texture);
  text_ += quoted(texture);
  return *this;
}

Statement& Statement::vector(std::string_view name, const std::array<double, 3>& value) {
  return list<double>(name, Type::vector3, value);
}

std::string transform_text(const Matrix4& m, std::string_view directive) {
  std::string out = fmt::format("{} [", directive);
  for (size_t column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      out += fmt::format("{}{}", column + size_t(row) == 0 ? "" : " ", m[row][column]);
  return out + "]\n";
}

}  // namespace duet::pbrt
