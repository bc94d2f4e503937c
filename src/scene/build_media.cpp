// Builds media, phase functions and volumes from their descriptions.
#include "media/heterogeneous.h"
#include "media/homogeneous.h"
#include "scene/builder.h"

namespace duet {

namespace {

/// Whether all nodes of the grid have the same values.
bool is_constant(const VolumeGrid& grid) {
  const size_t channels = size_t(grid.channels);
  for (size_t i = channels; i < grid.values.size(); ++i)
    if (grid.values[i] != grid.values[i - channels]) return false;
  return true;
}

CloudShape shape_of(const CloudDescription& d) {
  const auto point = [](const std::array<double, 3>& p) {
    return Point3f(float(p[0]), float(p[1]), float(p[2]));
  };
  return {point(d.lower), point(d.upper), float(d.density), float(d.wispiness), float(d.frequency)};
}

bool has_negative(const VolumeGrid& grid) {
  for (const float v : grid.values)
    if (v < 0) return true;
  return false;
}

}  // namespace

const GridVolume* SceneBuilder::volume(VolumeId id) {
  const size_t index = size_t(id);
  return once(volumes_[index], [&]() -> const GridVolume* {
    const VolumeDescription& d = description_.volumes[index];
    if (!check_transform(d.to_world, d.where)) return nullptr;
    scene_->volumes.push_back(
        std::make_unique<GridVolume>(d.grid, d.to_world, d.filter, d.wrap, d.nodes));
    return scene_->volumes.back().get();
  });
}

ColorVolumeSlot SceneBuilder::slot(const ColorVolume& input) {
  if (const auto* constant = std::get_if<Spectrum>(&input)) return {*constant, nullptr};
  const VolumeId id = std::get<VolumeId>(input);
  const VolumeDescription& d = description_.volumes[size_t(id)];
  if (d.grid->channels == 6)
    diagnostics_.error(d.where, "a volume with 6 channels is neither a number nor a colour");
  else if (has_negative(*d.grid))
    diagnostics_.error(d.where, "the volume has negative values");
  return {Spectrum(0.0f), volume(id)};
}

FloatVolumeSlot SceneBuilder::slot(const FloatVolume& input) {
  if (const auto* constant = std::get_if<double>(&input)) return {float(*constant), nullptr};
  const ColorVolumeSlot color = slot(ColorVolume(std::get<VolumeId>(input)));
  return {0, color.grid};
}

const PhaseFunction* SceneBuilder::phase(PhaseId id) {
  const size_t index = size_t(id);
  return once(phases_[index], [&]() -> const PhaseFunction* {
    const PhaseDescription& d = description_.phases[index];
    auto made = std::visit([&](const auto& f) { return f.build(*this, d.where); }, d.model);
    if (!made) return nullptr;
    scene_->phases.push_back(std::move(made));
    return scene_->phases.back().get();
  });
}

PhasePointer IsotropicPhase::build(SceneBuilder&, const SourceLocation&) const {
  return std::make_unique<Isotropic>();
}

PhasePointer HenyeyGreensteinPhase::build(SceneBuilder&, const SourceLocation&) const {
  return std::make_unique<HenyeyGreenstein>(float(g));
}

PhasePointer RayleighPhase::build(SceneBuilder&, const SourceLocation&) const {
  return std::make_unique<Rayleigh>();
}

PhasePointer TabulatedPhase::build(SceneBuilder&, const SourceLocation&) const {
  return std::make_unique<Tabulated>(values);
}

std::vector<std::string> SggxPhase::losses() const {
  if (std::holds_alternative<VolumeId>(matrix)) return {};
  return {"a constant matrix of \"sggx\" is missing"};
}

PhasePointer SggxPhase::build(SceneBuilder& b, const SourceLocation& where) const {
  MatrixVolume made;
  if (const auto* constant = std::get_if<std::array<double, 6>>(&matrix)) {
    for (size_t i = 0; i < 6; ++i) made.constant[i] = float((*constant)[i]);
    return std::make_unique<Sggx>(made);
  }
  const VolumeId id = std::get<VolumeId>(matrix);
  const VolumeGrid& grid = b.grid(id);
  if (grid.channels != 6) {
    b.diagnostics().error(where, "the parameter \"S\" needs a volume with 6 channels, not {}",
                          grid.channels);
    return nullptr;
  }
  if (is_constant(grid))
    std::copy_n(grid.values.begin(), 6, made.constant.begin());
  else if (!(made.grid = b.volume(id)))
    return nullptr;
  return std::make_unique<Sggx>(made);
}

PhasePointer BlendPhase::build(SceneBuilder& b, const SourceLocation& where) const {
  const PhaseFunction *one = b.phase(first), *other = b.phase(second);
  if (!one || !other) return nullptr;
  if (one->is_microflake() || other->is_microflake()) {
    b.diagnostics().error(where, "microflakes (\"sggx\") cannot be blended");
    return nullptr;
  }
  return std::make_unique<BlendedPhase>(b.slot(weight), *one, *other);
}

std::vector<std::string> VolumeDescription::losses() const {
  std::vector<std::string> lost;
  if (file.empty()) lost.emplace_back("a grid that does not come from a file is missing");
  if (!is_float32)
    lost.emplace_back("Mitsuba 3 reads only volume files with 32-bit floating-point numbers");
  if (nodes == VolumeNodes::beyond)
    lost.emplace_back("the nodes of a grid lie half a cell inside its box, not outside");
  if (nodes == VolumeNodes::on_faces)
    lost.emplace_back(
        "the nodes of a grid lie half a cell inside its box, which nothing is cut off "
        "at");
  return lost;
}

std::vector<std::string> MediumDescription::losses() const {
  std::vector<std::string> lost;
  if (cloud) lost.emplace_back("a cloud of noise is a medium of constant extinction");
  if (emission) lost.emplace_back("the emission of a medium is missing");
  return lost;
}

uint32_t SceneBuilder::medium(std::optional<MediumId> id) {
  if (!id) return kNone;
  Made<Medium>& made = media_[size_t(*id)];
  once(made, [&]() -> const Medium* {
    auto medium = make(description_.media[size_t(*id)]);
    if (!medium) return nullptr;
    made.index = uint32_t(scene_->media.size());
    scene_->media.push_back(std::move(medium));
    return scene_->media.back().get();
  });
  return made.index;
}

std::unique_ptr<Medium> SceneBuilder::make(const MediumDescription& m) {
  const PhaseFunction* function = phase(m.phase);
  const ColorVolumeSlot sigma_t = slot(m.sigma_t), albedo = slot(m.albedo);
  if (!function) return nullptr;
  const float scale = float(m.scale);
  std::optional<MediumEmission> emission;
  if (m.emission) {
    const ColorVolumeSlot radiance = slot(m.emission->radiance);
    const auto id = m.emission->temperature;
    const GridVolume* temperature = id ? volume(*id) : nullptr;
    if (id && !temperature) return nullptr;
    emission = temperature ? MediumEmission(radiance, *temperature, m.emission->colors,
                                            float(m.emission->hottest))
                           : MediumEmission(radiance);
  }
  if (m.cloud) {
    if (!check_transform(m.cloud->to_world, m.where)) return nullptr;
    const CloudVolume cloud(shape_of(*m.cloud), sigma_t.constant, m.cloud->to_world);
    return std::make_unique<HeterogeneousMedium<CloudVolume>>(cloud, scale, albedo, *function,
                                                              emission);
  }
  if (sigma_t.grid)
    return std::make_unique<HeterogeneousMedium<GridVolume>>(*sigma_t.grid, scale, albedo,
                                                             *function, emission);
  if (std::holds_alternative<VolumeId>(m.sigma_t)) return nullptr;
  if (function->extinction_varies()) {
    diagnostics_.error(m.where,
                       "microflakes that differ from place to place need the extinction as a grid");
    return nullptr;
  }
  if (emission && (!emission->is_constant() || albedo.grid)) {
    diagnostics_.error(m.where, "emission that varies needs the extinction as a grid");
    return nullptr;
  }
  return std::make_unique<HomogeneousMedium>(sigma_t.constant * scale, albedo, *function,
                                             emission ? (*emission)({}) : Spectrum());
}

}  // namespace duet
