#include "evaluate/report/description_text.h"

#include <filesystem>

#include "evaluate/report/overloaded.h"
#include "scene/filter_fields.h"

namespace duet {

namespace {

std::string text(const Spectrum& s) {
  if (s.r == s.g && s.g == s.b) return fmt::format("{:g}", s.r);
  return fmt::format("{:.4g} {:.4g} {:.4g}", s.r, s.g, s.b);
}

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

/// Where the origin of a transform lies.
std::string place(const Matrix4& m) {
  return fmt::format("at ({:.4g}, {:.4g}, {:.4g})", m[0][3], m[1][3], m[2][3]);
}

/// Where a transform's +z axis points.
std::string direction(const Matrix4& m) {
  return fmt::format("towards ({:.4g}, {:.4g}, {:.4g})", m[0][2], m[1][2], m[2][2]);
}

/// Both, or what the light says of them.
std::string pose(LightPose shown, const Matrix4& m) {
  std::string text;
  if (shown == LightPose::place || shown == LightPose::both) text += " " + place(m);
  if (shown == LightPose::direction || shown == LightPose::both) text += " " + direction(m);
  return text;
}

template <class T>
LightPose pose_of(const T&) {
  return T::kPose;
}
LightPose pose_of(const ForeignLight& light) {
  return light.operations().pose;
}

}  // namespace

std::string DescriptionText::value_text(double value) const {
  return fmt::format("{:g}", value);
}
std::string DescriptionText::value_text(const Spectrum& value) const {
  return text(value);
}

std::string DescriptionText::value_text(const FilmResponse& value) const {
  return value_text(value[0]) + value_text(value[1]) + value_text(value[2]);
}

std::string DescriptionText::value_text(const CropWindow& value) const {
  return fmt::format("{},{},{},{}", value.x, value.y, value.width, value.height);
}

std::string DescriptionText::value_text(const FilterDescription& value) const {
  std::string text;
  with_filter(value, [&](const auto& filter) {
    text = filter.name() + std::string(" filter") + shown_fields(filter);
  });
  if (value.reach_x || value.reach_y)
    text += fmt::format(" of extent {:g} x {:g}", value.reach_x.value_or(value.radius),
                        value.reach_y.value_or(value.radius));
  return text;
}

std::string DescriptionText::value_text(const std::vector<LensSurface>& value) const {
  return std::to_string(value.size());
}

std::string DescriptionText::value_text(const std::vector<ShapeDescription>& value) const {
  std::string text;
  for (const ShapeDescription& shape : value)
    text += (text.empty() ? "" : ", ") + shape_kind(shape);
  return text;
}

std::string DescriptionText::name(MaterialId id) const {
  const std::string& label = scene_.materials[size_t(id)].label.text;
  return label.empty() ? fmt::format("#{}", size_t(id)) : label;
}

std::string DescriptionText::name(MediumId id) const {
  const std::string& label = scene_.media[size_t(id)].label.text;
  return label.empty() ? fmt::format("medium #{}", size_t(id)) : label;
}

std::string DescriptionText::input(const ColorVolume& input) const {
  if (const auto* constant = std::get_if<Spectrum>(&input)) return text(*constant);
  const VolumeDescription& v = scene_.volumes[size_t(std::get<VolumeId>(input))];
  const auto& n = v.grid->size;
  return fmt::format("{} ({}x{}x{})", v.file.empty() ? "grid" : file_name(v.file), n[0], n[1],
                     n[2]);
}

std::string DescriptionText::phase(PhaseId id) const {
  const auto text_of = [this](const auto& model) {
    std::vector<std::string> nested;
    for_each_field(model, [&]<class M>(const FieldFacts&, const M& value) {
      if constexpr (std::is_same_v<M, PhaseId>) nested.push_back(phase(value));
    });
    const std::string line = model.name() + shown_fields(model);
    return nested.empty() ? line : fmt::format("{} [{}]", line, fmt::join(nested, "; "));
  };
  return std::visit(
      Overloaded{
          [](const TabulatedPhase& f) {
            return fmt::format("tabphase of {} values", f.values.size());
          },
          text_of,
      },
      scene_.phases[size_t(id)].model);
}

std::string DescriptionText::medium(const MediumDescription& m) const {
  return fmt::format("sigma_t {}, scale {:g}, albedo {}, phase {}", input(m.sigma_t), m.scale,
                     input(m.albedo), phase(m.phase));
}

std::string DescriptionText::texture_name(TextureId id) const {
  const TextureDescription& t = scene_.textures[size_t(id)];
  if (!t.label.text.empty()) return t.label.text;
  if (const auto* bitmap = std::get_if<BitmapTexture>(&t.model)) return file_name(bitmap->file);
  return fmt::format("texture #{}", size_t(id));
}

std::string DescriptionText::input(const ColorInput& input) const {
  if (const auto* id = std::get_if<TextureId>(&input)) return texture_name(*id);
  return text(std::get<Spectrum>(input));
}

std::string DescriptionText::input(const FloatInput& input) const {
  if (const auto* id = std::get_if<TextureId>(&input)) return texture_name(*id);
  return value_text(std::get<double>(input));
}

std::string DescriptionText::texture(const TextureDescription& t) const {
  const std::string label = t.label.text.empty() ? "" : t.label.text + ": ";
  return label +
         std::visit(Overloaded{
                        [](const CurvatureTexture& m) {
                          return fmt::format("{} curvature times {:.4g}",
                                             CurvatureTexture::kKinds[size_t(m.shown)], m.scale);
                        },
                        [&](const ScaledTextureDescription& m) {
                          return fmt::format("{} times {}", text(m.scale), texture_name(m.inner));
                        },
                        [&](const auto& m) { return m.name() + shown_fields(m); },
                    },
                    t.model);
}

std::string DescriptionText::shape_kind(const ShapeDescription& s) const {
  return std::visit(
      Overloaded{
          [](const MeshShape& m) {
            return m.source->plugin.empty() ? std::string("mesh") : m.source->plugin;
          },
          [](const CurvesShape& m) {
            return fmt::format("{} ({}, {} segments)", m.name(), file_name(m.file),
                               m.curves->segments.size());
          },
          [this](const HeightFieldShape& m) { return "heightfield of " + texture_name(m.heights); },
          [this](const auto& m) { return m.name() + shown_fields(m); },
      },
      s.geometry);
}

std::string DescriptionText::shape(const ShapeDescription& s) const {
  std::string t = shape_kind(s);
  if (!s.label.text.empty()) t += " " + s.label.text;
  if (const auto* instance = std::get_if<InstanceShape>(&s.geometry)) {
    const std::string& group = scene_.groups[instance->group].label.text;
    return t + " of " + (group.empty() ? fmt::format("group #{}", instance->group) : group) +
           (s.motion.empty() ? "" : ", moves");
  }
  if (const auto* m = std::get_if<MeshShape>(&s.geometry)) {
    if (!m->source->file.empty()) t += fmt::format(" ({})", file_name(m->source->file));
    t += fmt::format(", {} triangles", m->mesh->triangles.size());
    if (m->displacement != FloatInput(0.0))
      t += fmt::format(", displaced by {} at edges of {:.4g}", input(m->displacement),
                       m->edge_length);
  }
  t += ", bsdf " + name(s.material);
  if (s.interior) t += ", inside " + name(*s.interior);
  if (s.exterior) t += ", outside " + name(*s.exterior);
  if (s.emission) t += ", emits " + input(s.emission->radiance);
  if (!s.motion.empty()) t += ", moves";
  return t;
}

std::string DescriptionText::area_light(const ShapeDescription& s) const {
  return fmt::format("{} on {}{}: {}", s.emission->name(), shape_kind(s),
                     s.label.text.empty() ? "" : " " + s.label.text, input(s.emission->radiance));
}

std::string DescriptionText::light(const LightDescription& l) const {
  const double time = scene_.sensors.empty() ? 0 : scene_.sensors[0].shutter[0];
  const Matrix4 m = l.motion.at(time) * l.to_world;
  const std::string t = std::visit(
      [&](const auto& p) { return p.name() + pose(pose_of(p), m) + shown_fields(p); }, l.model);
  return t + (l.motion.empty() ? "" : ", moves");
}

std::string DescriptionText::sensor(const SensorDescription& s) const {
  std::string t = s.name();
  if (s.kind == SensorKind::batch)
    t += fmt::format(" of {} sensors", s.parts.size());
  else if (s.kind == SensorKind::irradiancemeter)
    t += " on " + shape_kind(scene_.shapes[s.shape]);
  else
    t += pose(LightPose::both, s.motion.at(s.shutter[0]) * s.to_world);
  return t + shown_fields(s) + (s.motion.empty() ? "" : ", moves");
}

std::string DescriptionText::film(const FilmDescription& f) const {
  return fmt::format("{}x{}", f.width, f.height) + shown_fields(f);
}

}  // namespace duet
