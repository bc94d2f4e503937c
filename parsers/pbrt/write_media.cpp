// Media as pbrt-v4 writes them.
#include "pbrt/scene_writer.h"

namespace duet::pbrt {

std::string SceneWriter::media(const std::optional<MediumId>& inside,
                               const std::optional<MediumId>& outside) {
  if (!inside && !outside) return {};
  const auto name = [&](const std::optional<MediumId>& id) {
    return Statement::quoted(id ? media_names_[size_t(*id)] : "");
  };
  return fmt::format("MediumInterface {} {}\n", name(inside), name(outside));
}

void SceneWriter::medium(size_t index) {
  const MediumDescription& m = d_.media[index];
  const std::string name = unique_name(m.label.text, "medium", index);
  media_names_.push_back(name);
  double g = 0;
  const auto& phase = d_.phases[size_t(m.phase)].model;
  if (const auto* hg = std::get_if<HenyeyGreensteinPhase>(&phase))
    g = hg->g;
  else if (!std::holds_alternative<IsotropicPhase>(phase))
    lose(fmt::format("the phase function \"{}\" is isotropic",
                     std::visit([](const auto& p) { return p.name(); }, phase)));
  const Spectrum* extinction = std::get_if<Spectrum>(&m.sigma_t);
  const Spectrum* albedo = std::get_if<Spectrum>(&m.albedo);
  if (!extinction || !albedo) return grid_medium(m, name, g);
  if (m.cloud) return cloud_medium(m, name, g);
  Statement s = named_medium(name, "homogeneous");
  s.color("sigma_a", *extinction * (Spectrum(1.0f) - *albedo))
      .color("sigma_s", *extinction * *albedo)
      .number("scale", m.scale)
      .number("g", g);
  if (m.emission) {
    const Spectrum* radiance = std::get_if<Spectrum>(&m.emission->radiance);
    if (radiance && !m.emission->temperature)
      s.color("Le", *radiance);
    else
      lose("emission that varies in a medium that does not is missing");
  }
  media_text_ += s.text();
}

void SceneWriter::cloud_medium(const MediumDescription& m, const std::string& name, double g) {
  const CloudDescription& c = *m.cloud;
  const Spectrum& extinction = std::get<Spectrum>(m.sigma_t);
  const Spectrum& albedo = std::get<Spectrum>(m.albedo);
  if (m.emission) lose("the emission of a cloud of noise is missing");
  Statement s = named_medium(name, "cloud");
  s.color("sigma_a", extinction * (Spectrum(1.0f) - albedo)).color("sigma_s", extinction * albedo);
  s.number("scale", m.scale).number("g", g);
  s.number("density", c.density).number("wispiness", c.wispiness).number("frequency", c.frequency);
  s.list<double>("p0", Type::point3, c.lower).list<double>("p1", Type::point3, c.upper);
  media_text_ += transform_text(c.to_world) + s.text() + "Identity\n";
}

}  // namespace duet::pbrt
