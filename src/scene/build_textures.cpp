// Builds textures from their descriptions.
#include "media/volume_texture.h"
#include "scene/builder.h"
#include "textures/checkerboard.h"
#include "textures/curvature_texture.h"
#include "textures/grid_texture.h"
#include "textures/mesh_attribute.h"
#include "textures/wireframe.h"

namespace duet {

const Texture* SceneBuilder::texture(TextureId id) {
  const size_t index = size_t(id);
  return once(textures_[index], [&]() -> const Texture* {
    const TextureDescription& d = description_.textures[index];
    auto made = std::visit([&](const auto& t) { return make(t, d.where); }, d.model);
    if (!made) return nullptr;
    scene_->textures.push_back(std::move(made));
    return scene_->textures.back().get();
  });
}

ColorSlot SceneBuilder::slot(const ColorInput& input) {
  if (const auto* constant = std::get_if<Spectrum>(&input)) return {*constant, nullptr};
  return {Spectrum(0.5f), texture(std::get<TextureId>(input))};
}

FloatSlot SceneBuilder::slot(const FloatInput& input) {
  if (const auto* constant = std::get_if<double>(&input)) return {float(*constant), nullptr};
  return {0.5f, texture(std::get<TextureId>(input))};
}

std::unique_ptr<Texture> SceneBuilder::make(const BitmapTexture& t, const SourceLocation& where) {
  auto image = pixels(t.file, {.raw = t.raw, .gamma = t.gamma, .channel = t.channel}, where);
  if (!image) return nullptr;
  return std::make_unique<Bitmap>(std::move(image), t.filter, t.wrap_u, t.wrap_v, t.to_uv);
}

std::unique_ptr<Texture> SceneBuilder::make(const CheckerboardTexture& t, const SourceLocation&) {
  const ColorSlot first = slot(t.color0), second = slot(t.color1);
  return std::make_unique<Checkerboard>(first, second, t.to_uv, t.swap_values);
}

std::unique_ptr<Texture> SceneBuilder::make(const MeshAttributeTexture& t, const SourceLocation&) {
  auto made = std::make_unique<MeshAttributeMap>(t.attribute, float(t.scale));
  shape_textures_.insert(made.get());
  return made;
}

std::unique_ptr<Texture> SceneBuilder::make(const GridLinesTexture& t, const SourceLocation&) {
  return std::make_unique<GridTexture>(slot(t.color0), slot(t.color1), float(t.line_width),
                                       t.to_uv);
}

std::unique_ptr<Texture> SceneBuilder::make(const WireframeTexture& t, const SourceLocation&) {
  WireframeOptions o{t.interior, t.edge, std::nullopt, float(t.step_width)};
  if (t.line_width) o.line_width = float(*t.line_width);
  auto made = std::make_unique<Wireframe>(o);
  shape_textures_.insert(made.get());
  return made;
}

std::unique_ptr<Texture> SceneBuilder::make(const CurvatureTexture& t, const SourceLocation&) {
  auto made = std::make_unique<CurvatureMap>(t.shown, float(t.scale));
  shape_textures_.insert(made.get());
  return made;
}

std::unique_ptr<Texture> SceneBuilder::make(const ScaledTextureDescription& t,
                                            const SourceLocation&) {
  const Texture* inner = texture(t.inner);
  return inner ? std::make_unique<ScaledTexture>(*inner, t.scale) : nullptr;
}

std::unique_ptr<Texture> SceneBuilder::make(const VolumeTextureDescription& t,
                                            const SourceLocation&) {
  return std::make_unique<VolumeTexture>(slot(ColorVolume(t.volume)));
}

std::shared_ptr<const BitmapPixels> SceneBuilder::pixels(const std::string& file,
                                                         const BitmapDecoding& decoding,
                                                         const SourceLocation& where) {
  constexpr double kFromFile = 0;  // no gamma value
  const auto [entry, is_new] = pixels_.try_emplace(
      {file, decoding.raw, decoding.gamma.value_or(kFromFile), decoding.channel});
  if (is_new) {
    try {
      entry->second =
          std::make_shared<BitmapPixels>(BitmapPixels::from_file(read_image(file), decoding));
    } catch (const ReadError& e) {
      diagnostics_.error(where, "{}", e.what());
    }
  }
  return entry->second;
}

}  // namespace duet
