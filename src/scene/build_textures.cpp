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
    auto made = std::visit([&](const auto& t) { return t.build(*this, d.where); }, d.model);
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

std::vector<std::string> BitmapTexture::losses() const {
  std::vector<std::string> lost;
  if (wrap_u != wrap_v)
    lost.emplace_back("a texture with different wrap modes in u and v has that of u");
  if (wrap_u == WrapMode::zero || wrap_u == WrapMode::one)
    lost.emplace_back("a texture that is zero or one outside of its image is clamped instead");
  if (gamma) lost.emplace_back("the gamma value of a texture is missing");
  if (channel != TextureChannel::all)
    lost.emplace_back("the choice of one channel of a texture is missing");
  if (colors) lost.emplace_back("the colour space of a texture is missing");
  return lost;
}

std::unique_ptr<Texture> BitmapTexture::build(SceneBuilder& b, const SourceLocation& where) const {
  auto image = b.pixels(file, decoding(), where);
  if (!image) return nullptr;
  return std::make_unique<Bitmap>(std::move(image), filter, wrap_u, wrap_v, to_uv);
}

std::unique_ptr<Texture> CheckerboardTexture::build(SceneBuilder& b, const SourceLocation&) const {
  const ColorSlot first = b.slot(color0), second = b.slot(color1);
  return std::make_unique<Checkerboard>(first, second, to_uv, swap_values);
}

std::unique_ptr<Texture> MeshAttributeTexture::build(SceneBuilder& b, const SourceLocation&) const {
  return b.on_shapes(std::make_unique<MeshAttributeMap>(attribute, float(scale)));
}

std::unique_ptr<Texture> GridLinesTexture::build(SceneBuilder& b, const SourceLocation&) const {
  return std::make_unique<GridTexture>(b.slot(color0), b.slot(color1), float(line_width), to_uv);
}

std::unique_ptr<Texture> WireframeTexture::build(SceneBuilder& b, const SourceLocation&) const {
  WireframeOptions o{interior, edge, std::nullopt, float(step_width)};
  if (line_width) o.line_width = float(*line_width);
  return b.on_shapes(std::make_unique<Wireframe>(o));
}

std::unique_ptr<Texture> CurvatureTexture::build(SceneBuilder& b, const SourceLocation&) const {
  return b.on_shapes(std::make_unique<CurvatureMap>(shown, float(scale)));
}

std::unique_ptr<Texture> ScaledTextureDescription::build(SceneBuilder& b,
                                                         const SourceLocation&) const {
  const Texture* texture = b.texture(inner);
  return texture ? std::make_unique<ScaledTexture>(*texture, scale) : nullptr;
}

std::unique_ptr<Texture> VolumeTextureDescription::build(SceneBuilder& b,
                                                         const SourceLocation&) const {
  return std::make_unique<VolumeTexture>(b.slot(ColorVolume(volume)));
}

std::shared_ptr<const BitmapPixels> SceneBuilder::pixels(const std::string& file,
                                                         const BitmapDecoding& decoding,
                                                         const SourceLocation& where) {
  const auto [entry, is_new] = pixels_.try_emplace({file, decoding});
  if (is_new) {
    try {
      entry->second =
          std::make_shared<BitmapPixels>(BitmapPixels::from_file(read_image(file), decoding));
      if (const size_t replaced = entry->second->replaced())
        diagnostics_.warning(
            where, "{}: {} numbers are not finite; NaN is taken for 0, infinity for 65504", file,
            replaced);
    } catch (const ReadError& e) {
      diagnostics_.error(where, "{}", e.what());
    }
  }
  return entry->second;
}

}  // namespace duet
