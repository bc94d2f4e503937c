// Images within [0, 1], as pbrt-v4 reads them where a reflectance is asked for.
#include <utility>

#include "pbrt/materials.h"

namespace duet::pbrt {

namespace {

using TextureModel = decltype(TextureDescription::model);

/// Makes copies of textures whose images are bounded, before anything is made of them.
class BoundedImages {
 public:
  explicit BoundedImages(Values& v) : v_(v) {}

  ColorInput operator()(const ColorInput& input) {
    const TextureId* id = std::get_if<TextureId>(&input);
    return id ? ColorInput(bounded(*id)) : input;
  }

 private:
  TextureId bounded(TextureId id) {
    if (is_image(id)) return std::get<TextureId>(clamped(v_, id));
    TextureModel model = model_of(id);
    const bool changed = std::visit([&](auto& t) { return change(t); }, model);
    return changed ? v_.reader().add_texture(std::move(model), v_.where()) : id;
  }

  /// A constant factor is one of the image, as in pbrt. Numbers are not bounded.
  bool is_image(TextureId id) const {
    const TextureModel& model = model_of(id);
    if (const auto* t = std::get_if<BitmapTexture>(&model))
      return t->channel != TextureChannel::number;
    if (const auto* t = std::get_if<ScaledTextureDescription>(&model)) return is_image(t->inner);
    if (const auto* t = std::get_if<MappedTextureDescription>(&model)) return is_image(t->inner);
    const auto* t = std::get_if<FunctionDescription>(&model);
    return t && t->function == TextureFunction::inverse && is_image(t->inner);
  }
  const TextureModel& model_of(TextureId id) const {
    return v_.reader().scene().textures[size_t(id)].model;
  }

  bool change(CheckerboardTexture& t) { return change(t.color0, t.color1); }
  bool change(SolidCheckerboardDescription& t) { return change(t.color0, t.color1); }
  bool change(DotsDescription& t) { return change(t.inside, t.outside); }
  bool change(MixDescription& t) { return change(t.first, t.second); }
  bool change(DirectionMixDescription& t) { return change(t.first, t.second); }
  /// The second factor is a number.
  bool change(ProductDescription& t) { return change(t.first); }
  bool change(ScaledTextureDescription& t) { return change(t.inner); }
  bool change(MappedTextureDescription& t) { return change(t.inner); }
  static bool change(const auto&) { return false; }

  bool change(TextureId& id) {
    const TextureId before = std::exchange(id, bounded(id));
    return id != before;
  }
  bool change(ColorInput& input) {
    TextureId* id = std::get_if<TextureId>(&input);
    return id && change(*id);
  }
  bool change(ColorInput& a, ColorInput& b) {
    const bool first = change(a);
    return change(b) || first;
  }

  Values& v_;
};

}  // namespace

ColorInput reflectance_input(Values& v, std::string_view name) {
  const ColorInput input = v.color_input(name, ColorMeaning::reflectance);
  const Reader& reader = v.reader();
  return reader.version() == Version::v3 || reader.awaits_colors() ? input
                                                                   : BoundedImages(v)(input);
}

}  // namespace duet::pbrt
