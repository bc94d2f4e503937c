// How formats make numbers and colours of the pixels of an image.
#include <map>

#include "evaluate/convert/new_files.h"
#include "image/image_io.h"
#include "scene/texture_texels.h"
#include "scene/texture_uses.h"

namespace duet {

namespace {

/// Whether a number of it is the same by any rule: it has one channel, or three that are equal.
bool is_grey(const ImageFile& file) {
  const Image& image = file.image;
  if (image.channel_count() == 1) return true;
  if (image.channel_count() != 3 || image.find_channel("R") != 0) return false;
  const auto equal = [](const auto& values) {
    for (size_t i = 0; i + 2 < values.size(); i += 3)
      if (values[i] != values[i + 1] || values[i] != values[i + 2]) return false;
    return true;
  };
  return equal(file.bytes) && equal(image.data);
}

/// Nothing if it cannot be read: that is reported when it is rendered.
std::optional<ImageFile> try_read(const std::string& path) {
  try {
    return read_image(path);
  } catch (const ReadError&) {
    return std::nullopt;
  }
}

}  // namespace

void settle_image_colors(SceneDescription& scene, NewFiles& files) {
  std::map<std::pair<std::string, BitmapDecoding>, std::string> names;
  for (TextureDescription& t : scene.textures) {
    auto* b = std::get_if<BitmapTexture>(&t.model);
    if (!b || !b->colors) continue;
    std::string& name = names[{b->file, b->decoding()}];
    if (name.empty()) {
      const TextureTexels texels = read_texels(*b);
      Image image(texels.width, texels.height, {"R", "G", "B"});
      for (size_t i = 0; i < texels.colors.size(); ++i)
        for (int c = 0; c < 3; ++c) image.data[3 * i + size_t(c)] = texels.colors[i][c];
      name = files.add_image("image", image);
    }
    b->file = name;
    b->gamma.reset(), b->colors.reset();
  }
}

void settle_images_for_mitsuba(SceneDescription& scene) {
  for (TextureDescription& t : scene.textures) {
    auto* b = std::get_if<BitmapTexture>(&t.model);
    if (!b) continue;
    if (b->gamma == 1) b->raw = true, b->gamma.reset();
    if (!b->gamma && b->channel != TextureChannel::number) continue;
    const auto file = try_read(b->file);
    if (file && b->gamma == -1 && file->display_encoded) b->gamma.reset();
    if (file && b->channel == TextureChannel::number && is_grey(*file))
      b->channel = TextureChannel::all;
  }
}

void settle_images_for_pbrt(SceneDescription& scene) {
  const std::vector<TextureUse> uses = texture_uses(scene);
  for (size_t i = 0; i < scene.textures.size(); ++i) {
    auto* b = std::get_if<BitmapTexture>(&scene.textures[i].model);
    if (!b || b->channel != TextureChannel::all || !uses[i].as_number || uses[i].as_color) continue;
    if (const auto file = try_read(b->file); file && is_grey(*file))
      b->channel = TextureChannel::number;
  }
}

}  // namespace duet
