// What surfaces have besides their geometry: transform, orientation, material, light and media.
#include <algorithm>
#include <cmath>
#include <utility>

#include "pbrt/reader.h"
#include "pbrt/shapes.h"
#include "pbrt/values.h"
#include "values/text.h"

namespace duet::pbrt {

void Reader::set_material(MaterialId id) {
  state_.material = id;
}

bool Reader::needs_uv(const Plugin& shape) const {
  return looks_at_uv_[size_t(state_.material)] || shape.find("alpha") ||
         (state_.area_light && state_.area_light->find("filename"));
}

void Reader::set_interior(MaterialId id, MediumDescription medium) {
  interiors_[id] = MediumId(scene_.media.size());
  scene_.media.push_back(std::move(medium));
}

bool Reader::is_interior(MediumId medium) const {
  return std::any_of(interiors_.begin(), interiors_.end(),
                     [&](const auto& own) { return own.second == medium; });
}

void Reader::share_interior(MaterialId from, MaterialId to) {
  if (const auto own = interiors_.find(from); own != interiors_.end()) interiors_[to] = own->second;
}

void Reader::set_looks_at_uv(MaterialId id, bool looks) {
  looks_at_uv_[size_t(id)] = looks;
}

std::optional<FloatInput> Reader::alpha_of(const Plugin& shape) {
  const Parameter* given = shape.find("alpha");
  if (!given || (given->type != Type::number && given->type != Type::texture)) return std::nullopt;
  // Everything else about the parameter was checked when the shape was read.
  Report::Mute mute(report_);
  Plugin alone{shape.directive, shape.name, shape.where, {*given}};
  const FloatInput alpha = Values(*this, alone, kShapeSpecs).float_input("alpha");
  // v3 asks only whether it is zero.
  if (const double* constant = std::get_if<double>(&alpha))
    if (*constant >= 1 || (version_ == Version::v3 && *constant > 0)) return std::nullopt;
  return alpha;
}

MaterialId Reader::with_alpha(const Plugin& shape, MaterialId material) {
  const std::optional<FloatInput> given = alpha_of(shape);
  if (!given) return material;
  FloatInput alpha = *given;
  const auto [entry, is_new] = masked_.try_emplace({material, alpha}, MaterialId{});
  if (!is_new) return entry->second;
  if (const TextureId* id = std::get_if<TextureId>(&alpha); id && version_ == Version::v3)
    alpha = add_texture(FunctionDescription{*id, TextureFunction::positive}, shape.where);
  entry->second = add_material(MaskMaterial{alpha, material}, shape.where);
  return entry->second;
}

void Reader::add_shape(const Plugin& from, ShapeParts parts) {
  if (!check_transform(state_.ctm[0], from.where)) return;
  ShapeDescription shape;
  shape.where = from.where;
  shape.motion = motion(from);
  shape.to_world = shape.motion.empty() ? state_.ctm[0] * parts.to_object : parts.to_object;
  const bool mirrored = state_.ctm[0].determinant3() < 0;
  // The normal in object space is turned inside out by ReverseOrientation, and the winding of
  // triangles once more by transforms that mirror.
  shape.flip_normals = state_.reverse_orientation != (mirrored && !parts.has_normals);
  if (parts.mirrors)
    shape.flip_normals = state_.reverse_orientation !=
                         (mirrored != ((state_.ctm[0] * parts.to_object).determinant3() < 0));
  shape.geometry = std::move(parts.geometry);
  shape.material = with_alpha(from, state_.material);
  const auto own = interiors_.find(state_.material);
  if (own != interiors_.end()) {
    shape.interior = own->second;
    shape.exterior = state_.outside;
  } else if (state_.inside != state_.outside) {
    shape.interior = state_.inside;
    shape.exterior = state_.outside;
  }
  if (state_.area_light) {
    const bool invisible = scene_.materials[size_t(state_.material)].model.is<NullMaterial>() &&
                           !is_awaited(state_.material);
    if (object_)
      report_.warning(from.where, "area lights in objects are ignored, as pbrt does");
    else if (version_ == Version::v3 && !shape.motion.empty())
      report_.warning(from.where, "surfaces that move emit no light, as in pbrt-v3");
    else if (version_ == Version::v4 && invisible)
      report_.warning(from.where, "a surface with the material \"interface\" emits no light");
    else
      shape.emission = read_area_light(*this, *state_.area_light,
                                       [&] { return area_of_light(from, shape, parts); });
    if (shape.emission) finish_emission(from, shape, parts.has_normals);
  }
  std::optional<uint32_t> group = object_;
  if (object_ && !shape.motion.empty()) {
    group = uint32_t(scene_.groups.size());
    moving_parts_[*object_].push_back({*group, std::exchange(shape.motion, {})});
    scene_.groups.push_back({from.where, {}, {}});
  }
  auto& list = group ? scene_.groups[*group].shapes : scene_.shapes;
  if (!undefined_materials_.empty() && is_awaited(state_.material))
    waiting_.push_back({state_.material, group, list.size(), state_.outside});
  list.push_back(std::move(shape));
}

void Reader::make_hair_round() {
  const auto is_hair = [](const MaterialModel& model) { return model.is<HairMaterial>(); };
  for_each_shape(scene_, [&](ShapeDescription& s) {
    auto* curves = std::get_if<CurvesShape>(&s.geometry);
    if (!curves || !holds(scene_, s.material, is_hair)) return;
    auto tubes = std::make_shared<CurveSet>(*curves->curves);
    tubes->profile = CurveProfile::tube;
    curves->curves = std::move(tubes);
  });
}

void Reader::finish_shapes() {
  add_awaited_instances();
  make_hair_round();
  for (const Waiting& w : waiting_) {
    ShapeDescription& shape = (w.group ? scene_.groups[*w.group].shapes : scene_.shapes)[w.index];
    if (const auto own = interiors_.find(w.material); own != interiors_.end()) {
      shape.interior = own->second;
      shape.exterior = w.outside;
    }
    if (shape.emission && scene_.materials[size_t(w.material)].model.is<NullMaterial>()) {
      report_.warning(shape.where, "a surface with the material \"interface\" emits no light");
      shape.emission.reset();
    }
  }
}

namespace {

/// Whether lengths change alike in all directions.
bool is_similarity(const Matrix4& m) {
  double squares[3][3] = {}, largest = 0;
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) squares[i][j] += m[k][i] * m[k][j];
      largest = std::max(largest, std::abs(squares[i][j]));
    }
  bool same = true;
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j)
      same &= std::abs(squares[i][j] - (i == j ? squares[0][0] : 0.0)) <= 1e-9 * largest;
  return same;
}

/// The motion `inner` of a part of what stands at `place`, or moves by `outer`. Where the way
/// between poses is not that between the products, it is followed in small steps.
Motion compose(const Matrix4& place, const Motion& outer, const Motion& inner) {
  std::vector<Keyframe> poses = inner.keyframes();
  if (!outer.empty() || !is_similarity(place)) {
    constexpr int kSteps = 32;
    const double begin = poses.front().time, length = poses.back().time - begin;
    poses.clear();
    for (int i = 0; i <= kSteps; ++i) {
      const double time = begin + length * i / kSteps;
      poses.push_back({time, inner.at(time)});
    }
  }
  for (Keyframe& k : poses) k.pose = outer.at(k.time) * place * k.pose;
  return Motion(std::move(poses));
}

}  // namespace

void Reader::begin_object(const std::string& name, const SourceLocation& where) {
  if (object_) {
    report_.error(where, "an object cannot stand in another");
    return;
  }
  // In v3 the name stands for the last one from here on.
  if (objects_.contains(name) && version_ == Version::v4) {
    report_.error(where, "there is an object {} already", in_quotes(name));
    return;
  }
  object_ = uint32_t(scene_.groups.size());
  objects_[name] = *object_;
  scene_.groups.push_back({where, {name}, {}});
}

void Reader::end_object(const SourceLocation& where) {
  if (!object_) report_.error(where, "ObjectEnd without ObjectBegin");
  object_.reset();
}

bool Reader::knows_object(const std::string& name, const SourceLocation& where) {
  if (objects_.contains(name)) return true;
  report_.error(where, "there is no object {}{}", in_quotes(name),
                did_you_mean(name, report_.names_for_hint(objects_)));
  return false;
}

void Reader::add_awaited_instances() {
  for (const AwaitedObject& use : std::exchange(awaited_objects_, {})) {
    if (!knows_object(use.name, use.where)) continue;
    state_.ctm = use.ctm;
    add_instance(use.name, use.where);
  }
}

void Reader::add_instance(const std::string& name, const SourceLocation& where) {
  if (object_) {
    report_.error(where, "an object cannot be used in another");
    return;
  }
  // v4 looks for objects when all files are read.
  if (version_ == Version::v4 && !objects_.contains(name)) {
    awaited_objects_.push_back({name, where, state_.ctm});
    return;
  }
  if (!knows_object(name, where) || !check_transform(state_.ctm[0], where)) return;
  const uint32_t group = objects_.at(name);
  ShapeDescription shape;
  shape.where = where;
  shape.geometry = InstanceShape{group};
  Plugin instance{"ObjectInstance", name, where, {}};
  shape.motion = motion(instance);
  if (shape.motion.empty()) shape.to_world = state_.ctm[0];
  const auto parts = moving_parts_.find(group);
  if (parts == moving_parts_.end()) {
    scene_.shapes.push_back(std::move(shape));
    return;
  }
  for (const MovingPart& part : parts->second) {
    ShapeDescription moving;
    moving.where = where;
    moving.geometry = InstanceShape{part.group};
    moving.motion = compose(shape.to_world, shape.motion, part.motion);
    scene_.shapes.push_back(std::move(moving));
  }
  if (!scene_.groups[group].shapes.empty()) scene_.shapes.push_back(std::move(shape));
}

}  // namespace duet::pbrt
