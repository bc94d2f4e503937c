// Builds the textures of description_pbrt_textures.h.
#include "scene/builder.h"
#include "textures/combined_textures.h"
#include "textures/solid_textures.h"

namespace duet {

std::unique_ptr<Texture> NoiseTextureDescription::build(SceneBuilder&,
                                                        const SourceLocation&) const {
  // More octaves than a number has digits change nothing.
  const NoiseOptions options{kind, std::clamp(octaves, 0, 64), float(roughness), float(scale),
                             float(variation)};
  return std::make_unique<NoiseTexture>(options, SpaceMap(from_world));
}

std::unique_ptr<Texture> SolidCheckerboardDescription::build(SceneBuilder& b,
                                                             const SourceLocation&) const {
  return std::make_unique<SolidCheckerboard>(b.slot(color0), b.slot(color1), SpaceMap(from_world));
}

std::unique_ptr<Texture> MappedTextureDescription::build(SceneBuilder& b,
                                                         const SourceLocation&) const {
  const Texture* texture = b.texture(inner);
  if (!texture) return nullptr;
  return std::make_unique<MappedTexture>(*texture, kind, SpaceMap(from_world));
}

std::unique_ptr<Texture> MixDescription::build(SceneBuilder& b, const SourceLocation&) const {
  return std::make_unique<MixTexture>(b.slot(first), b.slot(second), b.slot(amount));
}

std::unique_ptr<Texture> ProductDescription::build(SceneBuilder& b, const SourceLocation&) const {
  return std::make_unique<ProductTexture>(b.slot(first), b.slot(second));
}

std::unique_ptr<Texture> DirectionMixDescription::build(SceneBuilder& b,
                                                        const SourceLocation& where) const {
  const double length = std::sqrt(x * x + y * y + z * z);
  if (!(length > 0 && std::isfinite(length))) {
    b.diagnostics().error(where, "the direction of a \"directionmix\" has no length");
    return nullptr;
  }
  const Vector3f direction(float(x / length), float(y / length), float(z / length));
  return std::make_unique<DirectionMixTexture>(b.slot(first), b.slot(second), direction);
}

std::unique_ptr<Texture> FunctionDescription::build(SceneBuilder& b, const SourceLocation&) const {
  const Texture* texture = b.texture(inner);
  return texture ? std::make_unique<FunctionTexture>(*texture, function) : nullptr;
}

std::unique_ptr<Texture> BilerpDescription::build(SceneBuilder&, const SourceLocation&) const {
  return std::make_unique<BilerpTexture>(v00, v01, v10, v11, to_uv, repeats);
}

std::unique_ptr<Texture> DotsDescription::build(SceneBuilder& b, const SourceLocation&) const {
  return std::make_unique<DotsTexture>(b.slot(inside), b.slot(outside), to_uv);
}

}  // namespace duet
