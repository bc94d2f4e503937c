#include "pbrt/reader.h"

#include <algorithm>
#include <filesystem>

#include "pbrt/directives.h"
#include "values/text.h"

namespace duet::pbrt {

Reader::Reader(const std::string& file, const Options& options, Version version, Report& report)
    : file_(file), options_(options), version_(version), report_(report) {
  scene_.file = file;
  state_.names = std::make_shared<NameTables>();
  // What surfaces have that are given no material.
  const SourceLocation start{std::make_shared<const std::string>(file), 1, 1};
  const MaterialId grey = add_material(DiffuseMaterial{}, start);
  state_.material = add_material(TwoSidedMaterial{grey, grey}, start);
  set_looks_at_uv(state_.material, false);
}

void Reader::read() {
  Directives(*this).read_main(file_);
  check_names();
  finish_camera(*this);
  finish_integrator(*this);
}

void Reader::approximate(const SourceLocation& where, std::string what) {
  for (const Diagnostic& d : scene_.approximations)
    if (d.message == what) return;
  report_.warning(where, "approximated: {}", what);
  scene_.approximations.push_back({Severity::warning, where, std::move(what)});
}

std::string find_file(const std::string& file, const std::string& name, const Options& options) {
  namespace fs = std::filesystem;
  const auto exists = [&](const std::string& path) {
    std::error_code ignored;
    return options.exists ? options.exists(path) : fs::exists(path, ignored);
  };
  std::vector<std::string> folders{fs::path(file).parent_path().string()};
  folders.insert(folders.end(), options.search_paths.begin(), options.search_paths.end());
  std::string slashes = name;
  if (name.empty() || name.find('\0') != name.npos) return "";
  for (const std::string& folder : folders)
    if (const std::string path = (fs::path(folder) / name).lexically_normal().string();
        exists(path))
      return path;
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  for (const std::string& folder : folders)
    if (const std::string path = (fs::path(folder) / slashes).lexically_normal().string();
        slashes != name && exists(path))
      return path;
  return "";
}

std::string Reader::file(const std::string& name, const SourceLocation& where) {
  std::string path = find_file(file_, name, options_);
  if (path.empty()) report_.error(where, "file {} not found", in_quotes(name));
  return path;
}

MaterialId Reader::add_material(MaterialModel model, const SourceLocation& where) {
  scene_.materials.push_back({where, {}, std::move(model)});
  looks_at_uv_.push_back(true);
  return MaterialId(scene_.materials.size() - 1);
}

TextureId Reader::add_texture(decltype(TextureDescription::model) model,
                              const SourceLocation& where) {
  scene_.textures.push_back({where, {}, std::move(model)});
  return TextureId(scene_.textures.size() - 1);
}

bool Reader::check_transform(const Matrix4& m, const SourceLocation& where) {
  if (m.is_finite() && m.is_affine() && m.inverse()) return true;
  report_.error(where, "the current transform cannot be used: it is not affine, or flattens space");
  return false;
}

Motion Reader::motion(const Plugin& what) {
  if (state_.ctm[0] == state_.ctm[1]) return {};
  for (const Matrix4& m : state_.ctm)
    if (!check_transform(m, what.where)) return {};
  if ((state_.ctm[0].determinant3() < 0) != (state_.ctm[1].determinant3() < 0)) {
    report_.error(what.where, "a motion from a transform to its mirror image flattens space");
    return {};
  }
  return Motion({{transform_times[0], state_.ctm[0]}, {transform_times[1], state_.ctm[1]}});
}

}  // namespace duet::pbrt
