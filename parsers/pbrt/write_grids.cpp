// Media given by grids, as pbrt-v4 writes them.
#include "pbrt/scene_writer.h"

namespace duet::pbrt {

namespace {

void check_volume(const VolumeDescription& v, const GridCells& cells,
                  const std::function<void(std::string)>& lose) {
  if (v.filter != VolumeFilter::trilinear) lose("a grid is interpolated linearly");
  if (v.wrap != VolumeWrap::clamp) lose("a grid does not go on beyond its box");
  if (!cells.fades()) lose("a grid fades out over half a cell at the faces of its box");
}

}  // namespace

void SceneWriter::coefficients(Statement& s, const MediumDescription& m, const GridCells& cells) {
  const VolumeId* density = std::get_if<VolumeId>(&m.sigma_t);
  const VolumeId* shares = std::get_if<VolumeId>(&m.albedo);
  std::optional<GridCells> albedo;
  if (shares) albedo.emplace(d_.volumes[size_t(*shares)]);
  // Grids of albedos go on to the faces of the box: what fades out is the extinction.
  const VolumeDescription* first = density ? &d_.volumes[size_t(*density)] : nullptr;
  const VolumeDescription* second = shares ? &d_.volumes[size_t(*shares)] : nullptr;
  const bool same = first && second && first->to_world == second->to_world &&
                    first->grid->size == second->grid->size && first->nodes == second->nodes;
  if (first && second && !same)
    lose("the albedo of a medium is that at the cells of its extinction");
  std::vector<float> absorbed, scattered;
  absorbed.reserve(3 * cells.count()), scattered.reserve(3 * cells.count());
  for (size_t cell = 0; cell < cells.count(); ++cell)
    for (int c = 0; c < 3; ++c) {
      const float t = density ? cells.value(cell, c) : std::get<Spectrum>(m.sigma_t)[c];
      const float a = albedo ? albedo->value(cells, cell, c) : std::get<Spectrum>(m.albedo)[c];
      absorbed.push_back(t * (1 - a));
      scattered.push_back(t * a);
    }
  s.list<float>("sigma_a", Type::rgb, absorbed);
  s.list<float>("sigma_s", Type::rgb, scattered);
}

void SceneWriter::grid_medium(const MediumDescription& m, const std::string& name, double g) {
  const VolumeId* density = std::get_if<VolumeId>(&m.sigma_t);
  const VolumeDescription& v =
      d_.volumes[size_t(density ? *density : std::get<VolumeId>(m.albedo))];
  const GridCells cells(v);
  check_volume(v, cells, [&](std::string what) { lose(std::move(what)); });
  if (m.cloud) lose("the noise of a cloud whose albedo varies is missing");
  const Spectrum* albedo = std::get_if<Spectrum>(&m.albedo);
  const bool is_uniform = density && albedo && cells.channels() == 1;
  const auto& n = cells.size();
  Statement s = named_medium(name, is_uniform ? "uniformgrid" : "rgbgrid");
  s.number("g", g).number("scale", m.scale);
  s.integer("nx", n[0]).integer("ny", n[1]).integer("nz", n[2]);
  s.list<int>("p0", Type::point3, std::array{0, 0, 0}).list<int>("p1", Type::point3, n);
  if (is_uniform) {
    s.color("sigma_a", Spectrum(1.0f) - *albedo).color("sigma_s", *albedo);
    std::vector<float> values;
    for (size_t cell = 0; cell < cells.count(); ++cell) values.push_back(cells.value(cell, 0));
    s.list<float>("density", Type::number, values);
  } else {
    coefficients(s, m, cells);
  }
  if (m.emission) grid_emission(s, *m.emission, cells, is_uniform);
  media_text_ += transform_text(cells.to_world()) + s.text() + "Identity\n";
}

}  // namespace duet::pbrt
