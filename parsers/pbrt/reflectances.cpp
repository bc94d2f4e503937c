// Reflectances within [0, 1], as pbrt-v4's materials take them.
#include <algorithm>
#include <map>

#include "pbrt/materials.h"

namespace duet::pbrt {

namespace {

bool is_within(double x) {
  return x >= 0 && x <= 1;
}
bool is_within(const Spectrum& c) {
  return is_within(double(c.r)) && is_within(double(c.g)) && is_within(double(c.b));
}

/// Finds out which textures may leave [0, 1].
class Bounds {
 public:
  explicit Bounds(const SceneDescription& scene) : scene_(scene) {}

  template <class Constant>
  bool within(const std::variant<Constant, TextureId>& input) {
    if (const Constant* constant = std::get_if<Constant>(&input)) return is_within(*constant);
    return within(std::get<TextureId>(input));
  }
  bool within(TextureId id) {
    const auto [entry, is_new] = known_.try_emplace(id, false);
    if (!is_new) return entry->second;
    const auto model = [&](const auto& t) { return texture(t); };
    return known_[id] = std::visit(model, scene_.textures[size_t(id)].model);
  }

 private:
  /// The bytes of an image are fractions of one.
  static bool texture(const BitmapTexture& t) {
    if (t.clamped) return true;
    const std::string file = to_lower(t.file);
    const auto ends = [&](const char* kind) { return file.ends_with(kind); };
    return ends(".png") || ends(".jpg") || ends(".jpeg") || ends(".tga") || ends(".bmp");
  }
  bool texture(const CheckerboardTexture& t) { return within(t.color0) && within(t.color1); }
  bool texture(const SolidCheckerboardDescription& t) {
    return within(t.color0) && within(t.color1);
  }
  bool texture(const DotsDescription& t) { return within(t.inside) && within(t.outside); }
  bool texture(const ScaledTextureDescription& t) { return is_within(t.scale) && within(t.inner); }
  bool texture(const ProductDescription& t) { return within(t.first) && within(t.second); }
  bool texture(const MixDescription& t) {
    return within(t.first) && within(t.second) && within(t.amount);
  }
  bool texture(const DirectionMixDescription& t) { return within(t.first) && within(t.second); }
  bool texture(const MappedTextureDescription& t) { return within(t.inner); }
  bool texture(const FunctionDescription& t) {
    if (t.function == TextureFunction::positive) return true;
    return t.function == TextureFunction::inverse && (within(t.inner) || is_inverse(t.inner));
  }
  /// Beyond the corners it goes on, unless it is constant.
  static bool texture(const BilerpDescription& t) {
    return is_within(t.v00) && t.v00 == t.v01 && t.v00 == t.v10 && t.v00 == t.v11;
  }
  static bool texture(const auto&) { return false; }

  bool is_inverse(TextureId id) const {
    const auto* f = std::get_if<FunctionDescription>(&scene_.textures[size_t(id)].model);
    return f && f->function == TextureFunction::inverse;
  }

  const SceneDescription& scene_;
  std::map<TextureId, bool> known_;
};

}  // namespace

ColorInput clamped(Values& v, const ColorInput& input) {
  if (const Spectrum* constant = std::get_if<Spectrum>(&input)) {
    Spectrum c = *constant;
    for (int i = 0; i < 3; ++i) c[i] = std::clamp(c[i], 0.0f, 1.0f);
    return c;
  }
  Reader& reader = v.reader();
  const TextureId id = std::get<TextureId>(input);
  if (!reader.awaits_colors() && Bounds(reader.scene()).within(id)) return input;
  // An image is clamped when it is read.
  const auto* image = std::get_if<BitmapTexture>(&reader.scene().textures[size_t(id)].model);
  if (image && !reader.awaits_colors()) {
    BitmapTexture copy = *image;
    copy.clamped = true;
    return reader.add_texture(std::move(copy), v.where());
  }
  // max(0, 1 - max(0, 1 - x))
  const TextureId once =
      reader.add_texture(FunctionDescription{id, TextureFunction::inverse}, v.where());
  return reader.add_texture(FunctionDescription{once, TextureFunction::inverse}, v.where());
}

ColorInput clamped_reflectance(Values& v, std::string_view name) {
  return clamped(v, reflectance_input(v, name));
}

}  // namespace duet::pbrt
