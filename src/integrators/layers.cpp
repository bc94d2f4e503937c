#include "integrators/layers.h"

#include <array>
#include <utility>

namespace duet {

namespace {

const std::array<std::pair<const char*, LayerKind>, 15> kNames{{
    {"albedo", LayerKind::albedo},
    {"depth", LayerKind::depth},
    {"position", LayerKind::position},
    {"uv", LayerKind::uv},
    {"normal", LayerKind::normal},
    {"sh_normal", LayerKind::normal},
    {"geo_normal", LayerKind::geo_normal},
    {"dp_du", LayerKind::dp_du},
    {"dp_dv", LayerKind::dp_dv},
    {"prim_index", LayerKind::prim_index},
    {"shape", LayerKind::shape_index},
    {"shape_index", LayerKind::shape_index},
    {"moments", LayerKind::moments},
    {"variance", LayerKind::variance},
    {"samples", LayerKind::samples},
}};

std::vector<const char*> suffixes(LayerKind kind) {
  switch (kind) {
    case LayerKind::albedo:
    case LayerKind::moments:
    case LayerKind::variance:
      return {"R", "G", "B"};
    case LayerKind::depth:
      return {"T"};
    case LayerKind::uv:
      return {"U", "V"};
    case LayerKind::prim_index:
    case LayerKind::shape_index:
    case LayerKind::samples:
      return {"I"};
    default:
      return {"X", "Y", "Z"};
  }
}

template <class Triple>
void put(const Triple& t, std::span<float> out) {
  out[0] = t.x, out[1] = t.y, out[2] = t.z;
}

}  // namespace

std::optional<LayerKind> find_layer(const std::string& name) {
  for (const auto& [text, kind] : kNames)
    if (name == text) return kind;
  return std::nullopt;
}

const std::vector<std::string>& layer_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> n;
    for (const auto& [text, kind] : kNames) n.emplace_back(text);
    return n;
  }();
  return names;
}

std::vector<std::string> layer_channels(const Layer& layer) {
  std::vector<std::string> channels;
  for (const char* s : suffixes(layer.kind)) channels.push_back(layer.name + "." + s);
  return channels;
}

SurfaceNeeds layer_needs(LayerKind kind) {
  const bool tangents = kind == LayerKind::dp_du || kind == LayerKind::dp_dv;
  return {kind == LayerKind::uv, tangents};
}

void evaluate_layer(LayerKind kind, const Scene& scene, const Surface& s, const Vector3f& wo,
                    const Hit& hit, std::span<float> out) {
  switch (kind) {
    case LayerKind::albedo: {
      const Spectrum a = scene.materials[s.shape->material]->albedo(s, wo);
      out[0] = a.r, out[1] = a.g, out[2] = a.b;
      break;
    }
    case LayerKind::depth:
      out[0] = hit.t;
      break;
    case LayerKind::position:
      put(s.position, out);
      break;
    case LayerKind::uv:
      out[0] = s.uv.x, out[1] = s.uv.y;
      break;
    case LayerKind::normal:
      put(s.shading.n, out);
      break;
    case LayerKind::geo_normal:
      put(s.ng, out);
      break;
    case LayerKind::dp_du:
      put(s.dp_du, out);
      break;
    case LayerKind::dp_dv:
      put(s.dp_dv, out);
      break;
    case LayerKind::prim_index:
      out[0] = float(hit.primitive);
      break;
    case LayerKind::shape_index:
      out[0] = float(hit.shape);
      break;
    case LayerKind::moments:
    case LayerKind::variance:
    case LayerKind::samples:
      break;
  }
}

}  // namespace duet
