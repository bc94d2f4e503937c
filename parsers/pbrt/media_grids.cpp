// Media given by grids.
#include <algorithm>

#include "pbrt/media.h"
#include "volume/nanovdb_file.h"

namespace duet::pbrt {

std::optional<std::array<int, 3>> grid_size(Values& v, size_t cells) {
  std::array<int, 3> n{v.integer("nx"), v.integer("ny"), v.integer("nz")};
  double product = 1;
  for (const int x : n) product *= double(x);
  if (std::min({n[0], n[1], n[2]}) >= 1 && product == double(cells)) return n;
  v.reader().report().error(v.where("nx"),
                            "a grid of {} x {} x {} cells needs as many values, not {}", n[0], n[1],
                            n[2], cells);
  return std::nullopt;
}

VolumeId add_grid(Values& v, const std::array<int, 3>& n, int channels,
                  const std::function<float(size_t cell, int channel)>& value, bool goes_on) {
  auto grid = std::make_shared<VolumeGrid>();
  grid->channels = channels;
  for (size_t i = 0; i < 3; ++i) grid->size[i] = n[i] + 2;
  grid->values.assign(grid->node_count() * size_t(channels), 0.0f);
  size_t node = 0;
  for (int z = -1; z <= n[2]; ++z)
    for (int y = -1; y <= n[1]; ++y)
      for (int x = -1; x <= n[0]; ++x, ++node) {
        const auto at = [](int i, int count) { return size_t(std::clamp(i, 0, count - 1)); };
        const bool inside = x == std::clamp(x, 0, n[0] - 1) && y == std::clamp(y, 0, n[1] - 1) &&
                            z == std::clamp(z, 0, n[2] - 1);
        const size_t cell = (at(z, n[2]) * size_t(n[1]) + at(y, n[1])) * size_t(n[0]) + at(x, n[0]);
        if (inside || goes_on)
          for (int c = 0; c < channels; ++c)
            grid->values[node * size_t(channels) + size_t(c)] = value(cell, c);
      }
  const auto p0 = v.point("p0"), p1 = v.point("p1");
  std::array<double, 3> size;
  for (size_t i = 0; i < 3; ++i) {
    size[i] = p1[i] - p0[i];
    if (!(size[i] > 0)) v.reader().report().error(v.where("p1"), "the medium's box is empty");
  }
  VolumeDescription volume;
  volume.where = v.where();
  volume.grid = std::move(grid);
  volume.nodes = VolumeNodes::beyond;
  volume.to_world = v.reader().state().ctm[0] * Matrix4::translate(p0[0], p0[1], p0[2]) *
                    Matrix4::scale(size[0], size[1], size[2]);
  if (size[0] > 0 && size[1] > 0 && size[2] > 0)
    v.reader().check_transform(volume.to_world, v.where());
  SceneDescription& scene = v.reader().scene();
  scene.volumes.push_back(std::move(volume));
  return VolumeId(scene.volumes.size() - 1);
}

MediumDescription read_uniform_grid(Values& v) {
  MediumDescription m = medium_from_sigma(v);
  const std::vector<double> density = v.numbers("density");
  const auto size = grid_size(v, density.size());
  if (!size) return m;
  const Spectrum extinction = std::get<Spectrum>(m.sigma_t);
  for (const double d : density)
    if (d < 0) {
      v.reader().report().error(v.where("density"), "densities must not be negative");
      return m;
    }
  if (extinction.r == extinction.g && extinction.g == extinction.b) {
    m.scale *= double(extinction.r);
    m.sigma_t = add_grid(v, *size, 1, [&](size_t cell, int) { return float(density[cell]); });
  } else {
    m.sigma_t = add_grid(v, *size, 3,
                         [&](size_t cell, int c) { return float(density[cell]) * extinction[c]; });
  }
  m.emission = read_grid_emission(v, *size);
  return m;
}

namespace {

/// The albedo of a cell; of one where nothing is, that of the cells around it, so that it does not
/// darken what is between them.
float albedo_near(const std::vector<Spectrum>& absorption, const std::vector<Spectrum>& scattering,
                  const std::array<int, 3>& n, size_t cell, int c) {
  if (const float t = absorption[cell][c] + scattering[cell][c]; t > 0)
    return scattering[cell][c] / t;
  const int x = int(cell % size_t(n[0])), y = int(cell / size_t(n[0]) % size_t(n[1])),
            z = int(cell / (size_t(n[0]) * size_t(n[1])));
  float scattered = 0, all = 0;
  for (int k = std::max(z - 1, 0); k <= std::min(z + 1, n[2] - 1); ++k)
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, n[1] - 1); ++j)
      for (int i = std::max(x - 1, 0); i <= std::min(x + 1, n[0] - 1); ++i) {
        const size_t near = (size_t(k) * size_t(n[1]) + size_t(j)) * size_t(n[0]) + size_t(i);
        scattered += scattering[near][c];
        all += absorption[near][c] + scattering[near][c];
      }
  return all > 0 ? scattered / all : 0.0f;
}

}  // namespace

MediumDescription read_rgb_grid(Values& v) {
  MediumDescription m;
  m.where = v.where();
  m.scale = v.not_negative("scale");
  m.phase = read_phase(v);
  std::vector<Spectrum> absorption, scattering;
  const auto read = [&](const char* name, std::vector<Spectrum>& out) {
    const Parameter* p = v.given(name);
    if (!p) return;
    if (p->type != Type::rgb) {
      v.reader().report().error(p->where, "parameter \"{}\" must be of type rgb", name);
      return;
    }
    for (size_t i = 0; i + 2 < p->numbers.size(); i += 3)
      out.push_back({float(p->numbers[i]), float(p->numbers[i + 1]), float(p->numbers[i + 2])});
  };
  read("sigma_a", absorption);
  read("sigma_s", scattering);
  const auto size = grid_size(v, std::max(absorption.size(), scattering.size()));
  if (!size) return m;
  const size_t cells = std::max(absorption.size(), scattering.size());
  for (auto* list : {&absorption, &scattering}) {
    if (list->empty()) list->assign(cells, Spectrum(1.0f));
    if (list->size() != cells) {
      v.reader().report().error(v.where(), "sigma_a and sigma_s have different numbers of cells");
      return m;
    }
  }
  m.sigma_t =
      add_grid(v, *size, 3, [&](size_t i, int c) { return absorption[i][c] + scattering[i][c]; });
  m.albedo = add_grid(
      v, *size, 3,
      [&](size_t i, int c) { return albedo_near(absorption, scattering, *size, i, c); }, true);
  m.emission = read_rgb_emission(v, *size);
  return m;
}

namespace {

/// Places the grid as the state says; its values times `factor`, unless that is one in all
/// channels.
VolumeId add_nano_vdb(Values& v, NanoVdbGrid read, const Spectrum& factor) {
  auto grid = std::make_shared<VolumeGrid>(std::move(read.grid));
  if (factor != Spectrum(1.0f)) {
    grid->channels = 3;
    std::vector<float> colors;
    colors.reserve(grid->values.size() * 3);
    for (const float x : grid->values)
      for (int c = 0; c < 3; ++c) colors.push_back(x * factor[c]);
    grid->values = std::move(colors);
  }
  VolumeDescription volume;
  volume.where = v.where("filename");
  volume.grid = std::move(grid);
  volume.nodes = VolumeNodes::on_faces;
  volume.to_world = v.reader().state().ctm[0] * read.to_world;
  v.reader().check_transform(volume.to_world, v.where());
  SceneDescription& scene = v.reader().scene();
  scene.volumes.push_back(std::move(volume));
  return VolumeId(scene.volumes.size() - 1);
}

}  // namespace

MediumDescription read_nano_vdb(Values& v) {
  MediumDescription m = medium_from_sigma(v);
  const std::string path = v.file("filename");
  if (path.empty()) {
    if (!v.has("filename")) v.reader().report().error(v.where(), "\"string filename\" is needed");
    return m;
  }
  const Spectrum extinction = std::get<Spectrum>(m.sigma_t);
  const bool grey = extinction.r == extinction.g && extinction.g == extinction.b;
  try {
    m.sigma_t = add_nano_vdb(v, read_nanovdb(path, v.string("gridname")),
                             grey ? Spectrum(1.0f) : extinction);
    if (grey) m.scale *= double(extinction.r);
    if (auto kelvin = find_nanovdb(path, v.string("temperaturename"))) {
      const auto& values = kelvin->grid.values;
      const double hottest = double(*std::max_element(values.begin(), values.end()));
      const VolumeId temperature = add_nano_vdb(v, *std::move(kelvin), Spectrum(1.0f));
      const float scale = float(v.not_negative(v.has("LeScale") ? "LeScale" : "Lescale"));
      if (scale > 0) m.emission = emission_by_temperature(v, Spectrum(scale), temperature, hottest);
    } else if (v.has("temperaturename")) {
      v.reader().report().warning(v.where("temperaturename"), "the file has no such grid");
    }
  } catch (const ReadError& e) {
    v.reader().report().error(v.where("filename"), "{}", e.what());
  }
  return m;
}

}  // namespace duet::pbrt
