#include "scene/bsdfs/coats.h"

#include "materials/layered_material.h"
#include "scene/builder.h"

namespace duet {

namespace {

bool is_mirror(const FloatInput& alpha_u, const FloatInput& alpha_v) {
  const double *u = std::get_if<double>(&alpha_u), *v = std::get_if<double>(&alpha_v);
  return u && v && std::max(*u, *v) < double(CoatLayerOptions::kSmoothAlpha);
}

CoatLayerOptions layer_options(SceneBuilder& b, const CoatLayer& layer) {
  const auto whole = [](double x) { return int(std::clamp(x, 1.0, 1e4)); };
  CoatLayerOptions o;
  o.eta = float(std::clamp(layer.eta, 1e-2, 1e2));
  o.alpha_u = b.slot(layer.alpha_u), o.alpha_v = b.slot(layer.alpha_v);
  o.thickness = b.slot(layer.thickness);
  o.albedo = b.slot(layer.albedo);
  o.g = b.slot(layer.g);
  o.max_depth = whole(layer.max_depth), o.samples = whole(layer.samples);
  return o;
}

}  // namespace

bool CoatLayer::is_smooth() const {
  return is_mirror(alpha_u, alpha_v);
}

Scattering CoatedDiffuseMaterial::scattering() const {
  return {.diffuse = true, .rough_reflection = !is_smooth(), .mirror = is_smooth()};
}

MaterialPointer CoatedDiffuseMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  return std::make_unique<CoatedDiffuse>(b.slot(reflectance), layer_options(b, *this));
}

Scattering CoatedConductorMaterial::scattering() const {
  const bool mirrors = is_smooth() && is_mirror(conductor_alpha_u, conductor_alpha_v);
  const Spectrum* color = std::get_if<Spectrum>(&albedo);
  const bool scatters = !color || !color->is_black();
  return {.diffuse = scatters, .rough_reflection = !mirrors, .mirror = is_smooth()};
}

MaterialPointer CoatedConductorMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  CoatedMetalOptions metal;
  metal.eta = b.slot(conductor_eta), metal.k = b.slot(conductor_k);
  if (reflectance) metal.reflectance = b.slot(*reflectance);
  metal.alpha_u = b.slot(conductor_alpha_u), metal.alpha_v = b.slot(conductor_alpha_v);
  return std::make_unique<CoatedConductor>(metal, layer_options(b, *this));
}

}  // namespace duet
