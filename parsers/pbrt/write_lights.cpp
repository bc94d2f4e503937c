// Lights as pbrt-v4 writes them.
#include <cmath>

#include "pbrt/scene_writer.h"

namespace duet::pbrt {

namespace {

/// From pbrt's light, with its +z up, to the description's, with its +y up: the inverse of what the
/// reader does.
Matrix4 z_up_inverse() {
  Matrix4 m;
  m.m = {{{0, 1, 0, 0}, {0, 0, 1, 0}, {-1, 0, 0, 0}, {0, 0, 0, 1}}};
  return m;
}

double stretch_of(const Matrix4& m) {
  return std::sqrt(m[0][2] * m[0][2] + m[1][2] * m[1][2] + m[2][2] * m[2][2]);
}

std::array<double, 3> place_of(const Matrix4& m) {
  return {m[0][3], m[1][3], m[2][3]};
}

}  // namespace

std::optional<SceneWriter::ScaledImage> SceneWriter::scaled_image(TextureId id) const {
  Spectrum scale(1.0f);
  const TextureDescription* t = &d_.textures[size_t(id)];
  while (const auto* scaled = std::get_if<ScaledTextureDescription>(&t->model)) {
    scale *= scaled->scale;
    t = &d_.textures[size_t(scaled->inner)];
  }
  const auto* image = std::get_if<BitmapTexture>(&t->model);
  if (!image) return std::nullopt;
  return ScaledImage{image, scale};
}

double SceneWriter::grey_scale(const Spectrum& scale, std::string_view of_what) {
  if (is_grey(scale)) return double(scale.r);
  lose(fmt::format("the tint of {} is missing", of_what));
  return double(scale.luminance());
}

ColorInput SceneWriter::radiance_before_alpha(const AreaEmission& e, const FloatInput& alpha) {
  const bool fades = alpha != FloatInput(1.0) && alpha != FloatInput(0.0);
  if (!fades) return e.radiance;
  const TextureId* id = std::get_if<TextureId>(&e.radiance);
  const auto* product =
      id ? std::get_if<ProductDescription>(&d_.textures[size_t(*id)].model) : nullptr;
  const double* constant = std::get_if<double>(&alpha);
  const ColorInput factor =
      constant ? ColorInput(Spectrum(float(*constant))) : std::get<TextureId>(alpha);
  if (product && product->first == factor) return product->second;
  lose("a light with an opacity is dimmed by it");
  return e.radiance;
}

void SceneWriter::emission(const AreaEmission& e, const FloatInput& alpha) {
  if (e.directional) return lose("light along the normals of a surface is missing");
  Statement s("AreaLightSource", "diffuse");
  const ColorInput radiance = radiance_before_alpha(e, alpha);
  if (const Spectrum* constant = std::get_if<Spectrum>(&radiance)) {
    s.color("L", *constant);
  } else {
    const auto image = scaled_image(std::get<TextureId>(radiance));
    if (!image) return lose("light whose radiance is a texture other than an image is missing");
    s.string("filename", image->image->file);
    s.number("scale", grey_scale(image->scale, "a light's image"));
    const UvTransform upright{{{{1, 0, 0}, {0, -1, 1}}}};
    if (!(image->image->to_uv == upright)) lose("the image of a light is upside down or moved");
  }
  if (e.side == EmittingSide::both) s.boolean("twosided", true);
  world_text_ += s.text();
}

SceneWriter::MaybeLight SceneWriter::light(const PointLight& m, const LightDescription&,
                                           Matrix4& to_world) {
  const std::array<double, 3> from = place_of(to_world);
  to_world = {};
  return Statement("LightSource", "point")
      .color("I", m.intensity)
      .list<double>("from", Type::point3, from);
}

SceneWriter::MaybeLight SceneWriter::light(const SpotLight& m, const LightDescription&, Matrix4&) {
  if (m.falloff == SpotFalloff::linear)
    lose("the edge of a spot light is smooth, not linear in the angle");
  if (m.falloff == SpotFalloff::quartic)
    lose("the edge of a spot light is t²(3 − 2t), not t⁴ as in pbrt-v3");
  if (m.texture) lose("the image of a spot light is missing");
  Statement s("LightSource", "spot");
  s.color("I", m.intensity).number("coneangle", m.cutoff_angle);
  s.number("conedeltaangle", m.cutoff_angle - m.beam_width);
  return s;
}

SceneWriter::MaybeLight SceneWriter::light(const DirectionalLight& m, const LightDescription&,
                                           Matrix4& to_world) {
  // pbrt takes no notice of stretches.
  return Statement("LightSource", "distant").color("L", m.irradiance * float(stretch_of(to_world)));
}

SceneWriter::MaybeLight SceneWriter::light(const ConstantLight& m, const LightDescription&,
                                           Matrix4&) {
  return Statement("LightSource", "infinite").color("L", m.radiance);
}

SceneWriter::MaybeLight SceneWriter::light(const EnvironmentMapLight& m, const LightDescription&,
                                           Matrix4& to_world) {
  if (m.layout != EnvironmentLayout::equal_area) {
    lose("an environment map by latitude and longitude is missing");
    return std::nullopt;
  }
  to_world = to_world * z_up_inverse();
  Statement s = Statement("LightSource", "infinite").string("filename", m.file);
  s.number("scale", m.scale * grey_scale(m.tint, "an environment map"));
  if (m.illuminance) s.number("illuminance", *m.illuminance);
  return s;
}

SceneWriter::MaybeLight SceneWriter::light(const GoniometricLight& m, const LightDescription&,
                                           Matrix4& to_world) {
  if (m.latitude_longitude) {
    lose("a goniometric image by latitude and longitude is missing");
    return std::nullopt;
  }
  Matrix4 swap;
  swap.m = {{{1, 0, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}}};
  to_world = to_world * swap;
  return Statement("LightSource", "goniometric").string("filename", m.file).color("I", m.scale);
}

SceneWriter::MaybeLight SceneWriter::light(const ProjectorLight& m, const LightDescription&,
                                           Matrix4& to_world) {
  const TextureId* id = std::get_if<TextureId>(&m.irradiance);
  const auto image = id ? scaled_image(*id) : std::nullopt;
  if (!image || m.fov_axis != FovAxis::smaller) {
    lose(
        "a projector without an image, or with its angle along another side than the shorter "
        "one, is missing");
    return std::nullopt;
  }
  if (!m.is_intensity) lose("the projector's image is intensity, not irradiance");
  to_world = to_world * Matrix4::scale(-1, 1, 1);
  return Statement("LightSource", "projection")
      .string("filename", image->image->file)
      .number("scale", m.scale * grey_scale(image->scale, "a projector"))
      .number("fov", m.fov);
}

void SceneWriter::light(const LightDescription& l) {
  Matrix4 to_world = l.to_world;
  if (!l.motion.empty()) {
    lose("lights do not move: they stand as they do when the shutter opens");
    to_world = l.motion.at(d_.sensors.empty() ? 0 : d_.sensors.front().shutter[0]) * to_world;
  }
  const auto write = [&]<class T>(const T& m) -> MaybeLight {
    if constexpr (requires { this->light(m, l, to_world); }) {
      return this->light(m, l, to_world);
    } else {
      lose(fmt::format("the light \"{}\" is missing", m.name()));
      return std::nullopt;
    }
  };
  MaybeLight s = std::visit(write, l.model);
  if (!s) return;
  if (l.portal) {
    std::vector<double> corners;
    for (const auto& p : l.portal->corners) corners.insert(corners.end(), p.begin(), p.end());
    s->list<double>("portal", Type::point3, corners);
  }
  world_text_ += "AttributeBegin\n" + media({}, l.medium);
  place(world_text_, to_world, {});
  world_text_ += s->text() + "AttributeEnd\n";
}

}  // namespace duet::pbrt
