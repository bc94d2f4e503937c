// The directives of pbrt files.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "pbrt/reader.h"

namespace duet::pbrt {

/// Reads files directive by directive and keeps the graphics state.
class Directives {
 public:
  explicit Directives(Reader& reader) : reader_(reader) {}
  /// The main file with what it includes. Throws nothing: what is wrong is reported.
  void read_main(const std::string& path);
  /// The same from memory.
  void read(Lexer& in);

 private:
  enum class Begun : uint8_t { attribute, transform, object };
  struct Saved {
    Begun what;
    SourceLocation where;
    GraphicsState state;
  };
  struct Command {
    std::string_view name;
    void (Directives::*run)(Lexer& in, const Plugin& directive);
    /// Where it may stand: 1 before WorldBegin, 2 after it, 3 anywhere.
    unsigned place = 3;
  };
  static std::span<const Command> commands();

  /// A file with what it includes, to its end.
  void read_file(const std::string& path, const SourceLocation& where);
  /// Whether the file may be opened while others are open: not twice, and not too deep. Counts it
  /// among them, as one that the lexer reads at that depth.
  bool may_open(const std::string& path, const Lexer* in, size_t depth,
                const SourceLocation& where);
  void directive(Lexer& in);
  /// To the next directive.
  void skip_arguments(Lexer& in);

  // What follows a directive.
  std::vector<double> take_numbers(Lexer& in, size_t count, const Plugin& d);
  std::string take_string(Lexer& in, const Plugin& d);
  /// A name and parameters, with those that `Attribute` has set for a kind of plugin.
  void take_plugin(Lexer& in, Plugin& d, std::string_view defaults = "");

  // Transforms (transform_directives.cpp)
  void identity(Lexer& in, const Plugin& d);
  void translate(Lexer& in, const Plugin& d);
  void scale(Lexer& in, const Plugin& d);
  void rotate(Lexer& in, const Plugin& d);
  void look_at(Lexer& in, const Plugin& d);
  void transform(Lexer& in, const Plugin& d);
  void concat_transform(Lexer& in, const Plugin& d);
  void coordinate_system(Lexer& in, const Plugin& d);
  void coord_sys_transform(Lexer& in, const Plugin& d);
  void active_transform(Lexer& in, const Plugin& d);
  void transform_times(Lexer& in, const Plugin& d);
  Matrix4 take_matrix(Lexer& in, const Plugin& d);
  void apply(const Matrix4& m);

  // Blocks
  void attribute_begin(Lexer& in, const Plugin& d);
  void attribute_end(Lexer& in, const Plugin& d);
  void transform_begin(Lexer& in, const Plugin& d);
  void transform_end(Lexer& in, const Plugin& d);
  void object_begin(Lexer& in, const Plugin& d);
  void object_end(Lexer& in, const Plugin& d);
  void object_instance(Lexer& in, const Plugin& d);
  void world_begin(Lexer& in, const Plugin& d);
  void world_end(Lexer& in, const Plugin& d);
  void include(Lexer& in, const Plugin& d);
  void import(Lexer& in, const Plugin& d);
  void push(Begun what, const SourceLocation& where);
  void pop(Begun what, const Plugin& d);

  // State and plugins
  void reverse_orientation(Lexer& in, const Plugin& d);
  void attribute(Lexer& in, const Plugin& d);
  void color_space(Lexer& in, const Plugin& d);
  void option(Lexer& in, const Plugin& d);
  void camera(Lexer& in, const Plugin& d);
  void film(Lexer& in, const Plugin& d);
  void filter(Lexer& in, const Plugin& d);
  void sampler(Lexer& in, const Plugin& d);
  void integrator(Lexer& in, const Plugin& d);
  void accelerator(Lexer& in, const Plugin& d);
  /// What only pbrt-v2 had.
  void of_version_2(Lexer& in, const Plugin& d);
  void shape(Lexer& in, const Plugin& d);
  void area_light(Lexer& in, const Plugin& d);
  void light(Lexer& in, const Plugin& d);
  void material(Lexer& in, const Plugin& d);
  void make_named_material(Lexer& in, const Plugin& d);
  void named_material(Lexer& in, const Plugin& d);
  /// Makes a material that has a name the current one.
  void use_material(const std::string& name, const SourceLocation& where);
  void texture(Lexer& in, const Plugin& d);
  void make_named_medium(Lexer& in, const Plugin& d);
  void medium_interface(Lexer& in, const Plugin& d);

  GraphicsState& state() { return reader_.state(); }
  Report& report() { return reader_.report(); }

  Reader& reader_;
  std::vector<Saved> saved_;
  struct OpenFile {
    std::string path;
    const Lexer* in;
    size_t depth;
  };
  std::vector<OpenFile> open_files_;
  std::map<std::string, std::array<Matrix4, 2>, std::less<>> coordinate_systems_;
  bool in_world_ = false;
};

}  // namespace duet::pbrt
