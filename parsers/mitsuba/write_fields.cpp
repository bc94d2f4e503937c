// The fields of a plugin as Mitsuba 3 writes them, or would.
#include "mitsuba/scene_writer.h"
#include "scene/filter_fields.h"

namespace duet {

namespace {

bool is_relative_index(const FieldFacts& facts) {
  return !facts.parameters.empty() && facts.parameters.front().type == ParameterType::ior;
}

}  // namespace

void SceneWriter::material(const MaterialDescription& m, const std::string& id) {
  out_.open("bsdf", m.model.name(), {}, id);
  fields(m.model);
  if (const std::string loss = m.model.loss(); !loss.empty()) lose(loss);
  out_.close();
}

void SceneWriter::texture(size_t index) {
  const TextureDescription& t = d_.textures[index];
  out_.open("texture", std::visit([](const auto& m) { return m.name(); }, t.model), {},
            texture_ids_[index]);
  std::visit([&](const auto& model) { plugin("texture", model); }, exchanged(index).model);
  out_.close();
}

TextureDescription SceneWriter::exchanged(size_t index) {
  TextureDescription t = d_.textures[index];
  auto* board = std::get_if<CheckerboardTexture>(&t.model);
  if (!board || !texture_uses_[index].as_number || board->swap_values) return t;
  if (texture_uses_[index].as_color)
    lose("a checkerboard used as colour and as number has its numbers exchanged");
  else
    std::swap(board->color0, board->color1);
  return t;
}

void SceneWriter::color(std::string_view name, const ColorInput& input) {
  if (const TextureId* id = std::get_if<TextureId>(&input))
    return out_.reference(name, texture_id(*id));
  const Spectrum& s = std::get<Spectrum>(input);
  // Mitsuba 3 refuses reflectances above 1 as <rgb>, not as numbers.
  if (s.r == s.g && s.g == s.b)
    out_.number(name, s.r);
  else
    out_.rgb(name, s);
}

void SceneWriter::number(std::string_view name, const FloatInput& input) {
  if (const TextureId* id = std::get_if<TextureId>(&input))
    out_.reference(name, texture_id(*id));
  else
    out_.number(name, std::get<double>(input));
}

void SceneWriter::volume(std::string_view name, VolumeId id) {
  const VolumeDescription& v = d_.volumes[size_t(id)];
  if (!v.file.empty() || v.grid->node_count() != 1 || v.grid->channels == 6) {
    out_.open("volume", v.name(), name);
    plugin("volume", v);
    return out_.close();
  }
  const std::vector<float>& c = v.grid->values;
  out_.open("volume", "constvolume", name);
  color("value", ColorInput(v.grid->channels == 1 ? Spectrum(c[0]) : Spectrum(c[0], c[1], c[2])));
  out_.transform("to_world", v.to_world);
  out_.close();
}

void SceneWriter::volume(std::string_view name, const ColorVolume& input) {
  if (const VolumeId* id = std::get_if<VolumeId>(&input)) return volume(name, *id);
  // Mitsuba 3 takes a plain <rgb> here for a reflectance, and refuses what is above 1.
  out_.open("volume", "constvolume", name);
  color("value", ColorInput(std::get<Spectrum>(input)));
  out_.close();
}

void SceneWriter::phase(PhaseId id) {
  std::visit(
      [&](const auto& model) {
        out_.open("phase", model.name());
        plugin("phase", model);
        out_.close();
      },
      d_.phases[size_t(id)].model);
}

void SceneWriter::medium(const MediumDescription& m, const std::string& id) {
  out_.open("medium", m.name(), {}, id);
  plugin("medium", m);
  out_.close();
}

void SceneWriter::field(const FieldFacts& facts, double value) {
  out_.number(facts.name(), value);
  if (is_relative_index(facts)) out_.number("ext_ior", 1);
}

void SceneWriter::field(const FieldFacts& facts, const FloatInput& value) {
  const bool nested = facts.name().empty();
  if (nested && std::holds_alternative<double>(value)) {
    out_.open("texture", "uniform");
    number("value", value);
    out_.close();
  } else {
    number(facts.name(), value);
  }
  if (is_relative_index(facts)) out_.number("ext_ior", 1);
}

void SceneWriter::field(const FieldFacts& facts, const FloatVolume& value) {
  if (const VolumeId* grid = std::get_if<VolumeId>(&value))
    volume(facts.name(), *grid);
  else
    out_.number(facts.name(), std::get<double>(value));
}

void SceneWriter::field(const FieldFacts& facts,
                        const std::variant<std::array<double, 6>, VolumeId>& value) {
  if (const VolumeId* grid = std::get_if<VolumeId>(&value)) volume(facts.name(), *grid);
}

void SceneWriter::field(const FieldFacts& facts, const std::vector<double>& value) {
  out_.string(facts.name(), fmt::format("{}", fmt::join(value, ", ")));
}

void SceneWriter::field(const FieldFacts& facts, const std::array<double, 2>& value) {
  if (facts.parameters.size() == 2)
    for (size_t i = 0; i < 2; ++i) out_.number(facts.parameters[i].name, value[i]);
  else
    out_.string(facts.name(), fmt::format("{}, {}", value[0], value[1]));
}

void SceneWriter::field(const FieldFacts& facts, const CropWindow& value) {
  const int numbers[] = {value.x, value.y, value.width, value.height};
  for (size_t i = 0; i < 4; ++i) out_.integer(facts.parameters[i].name, numbers[i]);
}

void SceneWriter::field(const FieldFacts&, const FilterDescription& value) {
  with_filter(value, [&](const auto& filter) {
    out_.open("rfilter", filter.name());
    plugin("filter", filter);
    out_.close();
  });
}

void SceneWriter::field(const FieldFacts&, const UvTransform& uv) {
  Matrix4 m;
  for (int i = 0; i < 2; ++i) m[i] = {uv.m[i][0], uv.m[i][1], 0, uv.m[i][2]};
  out_.transform("to_uv", m);
}

void SceneWriter::field(const FieldFacts& facts, const Roughness& r) {
  out_.string("distribution", kMicrofacetNames[size_t(r.distribution)]);
  if (!facts.has_parameter("alpha_u") || r.alpha_u == r.alpha_v) {
    number("alpha", r.alpha_u);
  } else {
    number("alpha_u", r.alpha_u);
    number("alpha_v", r.alpha_v);
  }
  if (!r.sample_visible) out_.boolean("sample_visible", false);
}

void SceneWriter::field(const FieldFacts& facts, const MaterialShares& value) {
  std::vector<double> weights;
  for (const auto& [weight, id] : value) weights.push_back(weight);
  field(facts, weights);
  for (const auto& [weight, id] : value) out_.reference({}, material_id(id));
}

}  // namespace duet
