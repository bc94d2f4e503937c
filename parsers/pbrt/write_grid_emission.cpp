// The light that media given by grids emit, as pbrt-v4 writes it.
#include <algorithm>
#include <cmath>

#include "pbrt/emission.h"
#include "pbrt/scene_writer.h"

namespace duet::pbrt {

namespace {

Spectrum color_of(const GridCells& cells, size_t cell) {
  return {cells.value(cell, 0), cells.value(cell, 1), cells.value(cell, 2)};
}

/// A colour and the factor of each cell; nothing if cells differ in more.
struct OneColor {
  Spectrum color{1.0f};
  std::vector<float> factors;
};
std::optional<OneColor> one_color(const GridCells& cells) {
  OneColor result;
  size_t brightest = 0;
  for (size_t i = 1; i < cells.count(); ++i)
    if (color_of(cells, i).max() > color_of(cells, brightest).max()) brightest = i;
  result.color = color_of(cells, brightest);
  const float most = result.color.max();
  for (size_t i = 0; i < cells.count(); ++i) {
    const Spectrum c = color_of(cells, i);
    const float factor = most > 0 ? c.max() / most : 0;
    result.factors.push_back(factor);
    for (int k = 0; k < 3; ++k)
      if (std::abs(c[k] - factor * result.color[k]) > 1e-5f * most) return std::nullopt;
  }
  return result;
}

}  // namespace

bool SceneWriter::uniform_emission(Statement& s, const EmissionDescription& e,
                                   const GridCells& cells) {
  OneColor light;
  if (const Spectrum* constant = std::get_if<Spectrum>(&e.radiance)) {
    light.color = *constant;
    light.factors.assign(cells.count(), 1);
  } else {
    const GridCells radiance(d_.volumes[size_t(std::get<VolumeId>(e.radiance))]);
    auto found = one_color(radiance);
    // One cell for the whole box is what pbrt has without Lescale.
    const bool is_whole = radiance.count() == 1;
    if (!found || !radiance.has_box_of(cells) || (!is_whole && !radiance.matches(cells)))
      return false;
    light = *std::move(found);
    if (is_whole && cells.count() > 1) light.factors.clear();
  }
  if (e.temperature) {
    // Black bodies have a colour; the scale is a number.
    const GridCells kelvin(d_.volumes[size_t(*e.temperature)]);
    const bool is_number =
        light.color == Spectrum(light.color.r) && (!light.factors.empty() || light.color.r == 1);
    if (!is_number || !kelvin.matches(cells)) return false;
    for (float& factor : light.factors) factor *= light.color.r;
    std::vector<float> values;
    for (size_t i = 0; i < cells.count(); ++i) values.push_back(kelvin.value(i, 0));
    s.list<float>("temperature", Type::number, values);
    s.number("temperatureoffset", e.offset).number("temperaturescale", e.factor);
  } else {
    s.color("Le", light.color);
  }
  if (!light.factors.empty()) s.list<float>("Lescale", Type::number, light.factors);
  return true;
}

bool SceneWriter::rgb_emission(Statement& s, const EmissionDescription& e, const GridCells& cells) {
  const VolumeId* id = std::get_if<VolumeId>(&e.radiance);
  if (!id || e.temperature) return false;
  const GridCells radiance(d_.volumes[size_t(*id)]);
  if (!radiance.has_box_of(cells)) return false;
  std::vector<float> values;
  for (size_t cell = 0; cell < cells.count(); ++cell)
    for (int c = 0; c < 3; ++c) values.push_back(radiance.value(cells, cell, c) / kUnscaled);
  s.list<float>("Le", Type::rgb, values);
  return true;
}

void SceneWriter::grid_emission(Statement& s, const EmissionDescription& e, const GridCells& cells,
                                bool is_uniform) {
  if (!(is_uniform ? uniform_emission(s, e, cells) : rgb_emission(s, e, cells)))
    lose("the emission of a medium given by a grid is missing");
}

}  // namespace duet::pbrt
