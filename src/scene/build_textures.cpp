// Builds textures from their descriptions.
#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "media/volume_texture.h"
#include "scene/builder.h"
#include "scene/texture_uses.h"
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

namespace {

/// With what is wrong with the file, if it cannot be read.
ReadImage read_pixels(const std::string& file, const BitmapDecoding& decoding) {
  try {
    return {std::make_shared<BitmapPixels>(BitmapPixels::from_file(read_image(file), decoding)),
            ""};
  } catch (const ReadError& e) {
    return {nullptr, e.what()};
  }
}

}  // namespace

void SceneBuilder::read_images() {
  const std::vector<TextureUse> uses = texture_uses_of_shapes(description_);
  std::vector<std::pair<const ImageKey, ReadImage>*> images;
  for (size_t i = 0; i < uses.size(); ++i) {
    const auto* bitmap = std::get_if<BitmapTexture>(&description_.textures[i].model);
    if (!bitmap || !(uses[i].as_color || uses[i].as_number)) continue;
    const auto [entry, is_new] = images_.try_emplace({bitmap->file, bitmap->decoding()});
    if (is_new) images.push_back(&*entry);
  }
  parallel_for(images.size(), std::min(options_.threads, kImagesAtOnce), [&](size_t i) {
    images[i]->second = read_pixels(images[i]->first.first, images[i]->first.second);
  });
}

std::shared_ptr<const BitmapPixels> SceneBuilder::pixels(const std::string& file,
                                                         const BitmapDecoding& decoding,
                                                         const SourceLocation& where,
                                                         Severity nonfinite) {
  ReadImage& image = images_[{file, decoding}];
  if (!image.pixels && image.error.empty()) image = read_pixels(file, decoding);
  if (image.pixels && image.pixels->replaced() > 0 && nonfinite == Severity::error)
    image = {nullptr, fmt::format("{}: has numbers that are not finite ({})", file,
                                  image.pixels->replaced())};
  if (std::exchange(image.is_told, true)) return image.pixels;
  if (!image.error.empty())
    diagnostics_.error(where, "{}", image.error);
  else if (const size_t replaced = image.pixels->replaced())
    diagnostics_.warning(
        where, "{}: has numbers that are not finite ({}); NaN is taken for 0, infinity for 65504",
        file, replaced);
  return image.pixels;
}

}  // namespace duet
