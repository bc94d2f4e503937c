#include "pbrt/directives.h"

#include <filesystem>

#include "values/text.h"

namespace duet::pbrt {

namespace {

/// Files that include each other; deeper is a mistake, too.
constexpr size_t kDeepest = 100;

}  // namespace

std::span<const Directives::Command> Directives::commands() {
  using D = Directives;
  static constexpr Command kCommands[] = {
      {"Shape", &D::shape, 2},
      {"AttributeBegin", &D::attribute_begin, 2},
      {"AttributeEnd", &D::attribute_end, 2},
      {"ObjectInstance", &D::object_instance, 2},
      {"Translate", &D::translate},
      {"Scale", &D::scale},
      {"Rotate", &D::rotate},
      {"Transform", &D::transform},
      {"ConcatTransform", &D::concat_transform},
      {"Identity", &D::identity},
      {"LookAt", &D::look_at},
      {"CoordinateSystem", &D::coordinate_system},
      {"CoordSysTransform", &D::coord_sys_transform},
      {"ActiveTransform", &D::active_transform},
      {"TransformTimes", &D::transform_times, 1},
      {"TransformBegin", &D::transform_begin, 2},
      {"TransformEnd", &D::transform_end, 2},
      {"Attribute", &D::attribute},
      {"ReverseOrientation", &D::reverse_orientation, 2},
      {"ObjectBegin", &D::object_begin, 2},
      {"ObjectEnd", &D::object_end, 2},
      {"AreaLightSource", &D::area_light, 2},
      {"LightSource", &D::light, 2},
      {"Material", &D::material, 2},
      {"MakeNamedMaterial", &D::make_named_material, 2},
      {"NamedMaterial", &D::named_material, 2},
      {"Texture", &D::texture, 2},
      {"MakeNamedMedium", &D::make_named_medium},
      {"MediumInterface", &D::medium_interface},
      {"Camera", &D::camera, 1},
      {"Film", &D::film, 1},
      {"Sampler", &D::sampler, 1},
      {"PixelFilter", &D::filter, 1},
      {"Filter", &D::filter, 1},
      {"Integrator", &D::integrator, 1},
      {"SurfaceIntegrator", &D::integrator, 1},
      {"Accelerator", &D::accelerator, 1},
      {"Renderer", &D::of_version_2, 1},
      {"VolumeIntegrator", &D::of_version_2, 1},
      {"ColorSpace", &D::color_space},
      {"Option", &D::option},
      {"Include", &D::include},
      {"Import", &D::import},
      {"WorldBegin", &D::world_begin, 1},
      {"WorldEnd", &D::world_end, 2},
  };
  return kCommands;
}

void Directives::read_main(const std::string& path) {
  read_file(path, {std::make_shared<const std::string>(path), 0, 0});
  for (const Saved& s : saved_) {
    constexpr const char* names[] = {"Attribute", "Transform", "Object"};
    const std::string wrong = fmt::format("{0}Begin without {0}End", names[size_t(s.what)]);
    if (reader_.version() == Version::v3)
      report().warning(s.where, "{}", wrong);
    else
      report().error(s.where, "{}", wrong);
  }
  if (!in_world_ && !report().has_errors())
    report().error({std::make_shared<const std::string>(path), 0, 0}, "there is no WorldBegin");
}

bool Directives::may_open(const std::string& path, const Lexer* in, size_t depth,
                          const SourceLocation& where) {
  // Whose end was reached since.
  while (!open_files_.empty() && open_files_.back().in == in && open_files_.back().depth >= depth)
    open_files_.pop_back();
  std::error_code error;
  std::string real = std::filesystem::canonical(path, error).string();
  if (error) real = path;
  for (const OpenFile& open : open_files_)
    if (open.path == real)
      return report().error(where, "the file {} includes itself", in_quotes(path)), false;
  if (open_files_.size() >= kDeepest)
    return report().error(where, "more than {} files include each other", kDeepest), false;
  open_files_.push_back({real, in, depth});
  return true;
}

void Directives::read_file(const std::string& path, const SourceLocation& where) {
  const size_t open_before = open_files_.size();
  try {
    Lexer in(path);
    if (may_open(path, &in, 0, where)) read(in);
  } catch (const ReadError& e) {
    report().error(where, "{}", e.what());
  }
  open_files_.resize(open_before);
}

void Directives::read(Lexer& in) {
  // After a mistake directives are looked for where lines begin.
  bool lost = false;
  while (true) {
    try {
      const Kind next = in.peek();
      if (next == Kind::end) return;
      if (next == Kind::word) {
        lost = false;
        directive(in);
        continue;
      }
      if (!lost) report().error(in.where(), "a directive is expected here");
      lost = true;
      std::vector<double> ignored;
      if (next == Kind::string)
        in.take_string();
      else if (next == Kind::number)
        in.take_numbers(ignored);
      else
        in.take_bracket();
    } catch (const SyntaxError& e) {
      if (!lost) report().error(e.where, "{}", e.message);
      lost = true;
      in.skip_to_next_line();
    }
  }
}

void Directives::directive(Lexer& in) {
  Plugin d;
  d.where = in.where();
  d.directive = in.take_word();
  for (const Command& c : commands())
    if (c.name == d.directive) {
      if (!(c.place & (in_world_ ? 2u : 1u))) {
        const std::string wrong =
            c.name == "WorldBegin"
                ? "the world has begun already"
                : fmt::format("{} stands {} WorldBegin", c.name, in_world_ ? "before" : "after");
        if (reader_.version() == Version::v3) {
          report().warning(d.where, "{}; it is ignored, as pbrt-v3 does", wrong);
          skip_arguments(in);
          return;
        }
        report().error(d.where, "{}", wrong);
      }
      (this->*c.run)(in, d);
      return;
    }
  std::vector<std::string> names;
  for (const Command& c : commands()) names.emplace_back(c.name);
  report().error(d.where, "there is no directive {}{}", in_quotes(d.directive),
                 did_you_mean(d.directive, names));
  skip_arguments(in);
}

void Directives::skip_arguments(Lexer& in) {
  Report::Mute mute(report());
  std::vector<double> ignored;
  while (true) {
    const Kind next = in.peek();
    if (next == Kind::string)
      in.take_string();
    else if (next == Kind::number)
      in.take_numbers(ignored), ignored.clear();
    else if (next == Kind::open || next == Kind::close)
      in.take_bracket();
    else
      return;
  }
}

std::vector<double> Directives::take_numbers(Lexer& in, size_t count, const Plugin& d) {
  std::vector<double> numbers;
  const bool list = in.peek() == Kind::open;
  if (list) in.take_bracket();
  if (in.peek() == Kind::number) in.take_numbers(numbers);
  if (list) {
    if (in.peek() != Kind::close) throw SyntaxError{in.where(), "a list without its end"};
    in.take_bracket();
  }
  if (numbers.size() != count)
    throw SyntaxError{d.where, fmt::format("{} needs {} number{}, not {}", d.directive, count,
                                           count == 1 ? "" : "s", numbers.size())};
  return numbers;
}

std::string Directives::take_string(Lexer& in, const Plugin& d) {
  if (in.peek() != Kind::string)
    throw SyntaxError{d.where, fmt::format("{} needs a text in quotes", d.directive)};
  return in.take_string();
}

void Directives::take_plugin(Lexer& in, Plugin& d, std::string_view defaults) {
  d.name = take_string(in, d);
  d.parameters = read_parameters(in, state().color_space, report());
  if (defaults.empty() || !state().defaults) return;
  const auto found = state().defaults->find(defaults);
  if (found == state().defaults->end()) return;
  for (const Parameter& p : found->second)
    if (!d.find(p.name)) d.parameters.push_back(p);
}

void Directives::include(Lexer& in, const Plugin& d) {
  const std::string path = reader_.file(take_string(in, d), d.where);
  if (path.empty() || !may_open(path, &in, in.depth() + 1, d.where)) return;
  try {
    in.include(path);
  } catch (const ReadError& e) {
    report().error(d.where, "{}", e.what());
  }
}

void Directives::import(Lexer& in, const Plugin& d) {
  if (!in_world_) report().error(d.where, "Import stands after WorldBegin");
  const std::string path = reader_.file(take_string(in, d), d.where);
  if (path.empty()) return;
  const GraphicsState before = state();
  read_file(path, d.where);
  state() = before;
}

}  // namespace duet::pbrt
