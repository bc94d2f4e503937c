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
        std::make_unique<GridVolume>(d.grid, d.to_world, d.filter, d.wrap, d.nodes_on_faces));
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
    auto made = std::visit([&](const auto& f) { return make(f, d.where); }, d.model);
    if (!made) return nullptr;
    scene_->phases.push_back(std::move(made));
    return scene_->phases.back().get();
  });
}

std::unique_ptr<PhaseFunction> SceneBuilder::make(const IsotropicPhase&, const SourceLocation&) {
  return std::make_unique<Isotropic>();
}

std::unique_ptr<PhaseFunction> SceneBuilder::make(const HenyeyGreensteinPhase& f,
                                                  const SourceLocation&) {
  return std::make_unique<HenyeyGreenstein>(float(f.g));
}

std::unique_ptr<PhaseFunction> SceneBuilder::make(const RayleighPhase&, const SourceLocation&) {
  return std::make_unique<Rayleigh>();
}

std::unique_ptr<PhaseFunction> SceneBuilder::make(const TabulatedPhase& f, const SourceLocation&) {
  return std::make_unique<Tabulated>(f.values);
}

std::unique_ptr<PhaseFunction> SceneBuilder::make(const SggxPhase& f, const SourceLocation& where) {
  MatrixVolume matrix;
  if (const auto* constant = std::get_if<std::array<double, 6>>(&f.matrix)) {
    for (size_t i = 0; i < 6; ++i) matrix.constant[i] = float((*constant)[i]);
    return std::make_unique<Sggx>(matrix);
  }
  const VolumeId id = std::get<VolumeId>(f.matrix);
  const VolumeGrid& grid = *description_.volumes[size_t(id)].grid;
  if (grid.channels != 6) {
    diagnostics_.error(where, "the parameter \"S\" needs a volume with 6 channels, not {}",
                       grid.channels);
    return nullptr;
  }
  if (is_constant(grid))
    std::copy_n(grid.values.begin(), 6, matrix.constant.begin());
  else if (!(matrix.grid = volume(id)))
    return nullptr;
  return std::make_unique<Sggx>(matrix);
}

std::unique_ptr<PhaseFunction> SceneBuilder::make(const BlendPhase& f,
                                                  const SourceLocation& where) {
  const PhaseFunction *first = phase(f.first), *second = phase(f.second);
  if (!first || !second) return nullptr;
  if (first->is_microflake() || second->is_microflake()) {
    diagnostics_.error(where, "microflakes (\"sggx\") cannot be blended");
    return nullptr;
  }
  return std::make_unique<BlendedPhase>(slot(f.weight), *first, *second);
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
  if (sigma_t.grid)
    return std::make_unique<HeterogeneousMedium>(*sigma_t.grid, scale, albedo, *function);
  if (std::holds_alternative<VolumeId>(m.sigma_t)) return nullptr;
  if (function->extinction_varies()) {
    diagnostics_.error(m.where,
                       "microflakes that differ from place to place need the extinction as a grid");
    return nullptr;
  }
  return std::make_unique<HomogeneousMedium>(sigma_t.constant * scale, albedo, *function);
}

}  // namespace duet
