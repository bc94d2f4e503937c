#include "scene/texture_value.h"

#include "scene/builder.h"

namespace duet {

std::optional<TextureValue> texture_at_origin(const SceneDescription& description, TextureId id,
                                              Diagnostics& diagnostics) {
  SceneDescription textures;
  textures.textures = description.textures;
  textures.volumes = description.volumes;
  SceneBuilder builder(std::move(textures), {});
  const auto value = builder.texture_at_origin(id);
  for (const Diagnostic& d : builder.diagnostics().all()) diagnostics.add(d);
  return value;
}

std::optional<TextureValue> SceneBuilder::texture_at_origin(TextureId id) {
  const Texture* made = texture(id);
  if (!made) return std::nullopt;
  if (!textures_[size_t(id)].shape_textures.empty()) {
    diagnostics_.error(description_.textures[size_t(id)].where,
                       "the texture has values on shapes alone, and is used elsewhere");
    return std::nullopt;
  }
  const Surface origin{};
  return TextureValue{made->color(origin), made->value(origin)};
}

}  // namespace duet
