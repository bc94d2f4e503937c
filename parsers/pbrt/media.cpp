// Participating media.
#include <algorithm>
#include <cmath>
#include <functional>

#include "pbrt/records.h"
#include "pbrt/values.h"
#include "pbrt/vocabulary.h"
#include "values/medium_presets.h"
#include "values/text.h"
#include "volume/nanovdb_file.h"

namespace duet::pbrt {

namespace {

using enum Status;

#define DUET_SIGMA_SPECS                                                                  \
  {"sigma_a", kColor, "1", "absorption", 1, done, Versions::both, "0.0011 0.0024 0.014"}, \
      {"sigma_s", kColor, "1", "scattering", 1, done, Versions::both, "2.55 3.21 3.77"},  \
      {"scale", kNumber, "1"}, {                                                          \
    "g", kNumber, "0", "mean cosine of scattering"                                        \
  }
#define DUET_GRID_SPECS                                                      \
  {"p0", kPoint3, "0 0 0"}, {"p1", kPoint3, "1 1 1"}, {"nx", kInteger, "1"}, \
      {"ny", kInteger, "1"}, {                                               \
    "nz", kInteger, "1"                                                      \
  }

constexpr Spec kHomogeneous[] = {DUET_SIGMA_SPECS,
                                 {"preset", kString},
                                 {"Le", kColor, "0", "emission", 1, refused},
                                 {"Lescale", kNumber, "1", "", 1, inert}};
constexpr Spec kUniformGrid[] = {DUET_SIGMA_SPECS,
                                 DUET_GRID_SPECS,
                                 {"density", kNumber, "", "x fastest, then y, then z", 0},
                                 {"preset", kString},
                                 {"Le", kColor, "0", "emission", 1, refused},
                                 {"Lescale", kNumber, "1", "", 0, inert},
                                 {"temperature", kNumber, "", "emission", 0, refused}};
constexpr Spec kRgbGrid[] = {{"sigma_a", kColor, "1", "per cell", 0},
                             {"sigma_s", kColor, "1", "per cell", 0},
                             {"scale", kNumber, "1"},
                             {"g", kNumber, "0"},
                             {"Le", kColor, "", "emission", 0, refused},
                             {"Lescale", kNumber, "1", "", 1, inert},
                             DUET_GRID_SPECS};

struct Sigma {
  Spectrum absorption, scattering;
};

Sigma read_sigma(Values& v) {
  Sigma s{v.color("sigma_a", ColorMeaning::unbounded), v.color("sigma_s", ColorMeaning::unbounded)};
  if (!v.has("preset")) return s;
  const std::string name = v.string("preset");
  if (const MediumPreset* preset = find_medium_preset(name))
    return {preset->sigma_a, preset->sigma_s};
  v.reader().report().error(v.where("preset"), "there is no medium {}{}", in_quotes(name),
                            did_you_mean(name, medium_preset_names()));
  return s;
}

PhaseId phase(Values& v) {
  SceneDescription& scene = v.reader().scene();
  const double g = v.number("g");
  if (!(g > -1 && g < 1))
    v.reader().report().error(v.where("g"), "g lies between -1 and 1, not at {}", g);
  PhaseDescription p;
  p.where = v.where();
  if (g == 0)
    p.model = IsotropicPhase{};
  else
    p.model = HenyeyGreensteinPhase{g};
  scene.phases.push_back(std::move(p));
  return PhaseId(scene.phases.size() - 1);
}

/// Extinction and the share of it that is scattered.
MediumDescription from_sigma(Values& v, const Sigma& s) {
  MediumDescription m;
  m.where = v.where();
  m.label = {v.plugin().name};
  const Spectrum extinction = s.absorption + s.scattering;
  Spectrum albedo;
  for (int c = 0; c < 3; ++c) albedo[c] = extinction[c] > 0 ? s.scattering[c] / extinction[c] : 0;
  m.sigma_t = extinction;
  m.albedo = albedo;
  m.scale = v.not_negative("scale");
  m.phase = phase(v);
  return m;
}

MediumDescription read_homogeneous(Values& v) {
  return from_sigma(v, read_sigma(v));
}

/// The numbers of cells; nothing after an error.
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

/// A grid over the medium's box. Around it there is nothing: cells of zero, half of whose reach
/// lies within the box. If it `goes_on`, its outermost cells are repeated instead.
VolumeId add_grid(Values& v, const std::array<int, 3>& n, int channels,
                  const std::function<float(size_t cell, int channel)>& value,
                  bool goes_on = false) {
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
  std::array<double, 3> low, size;
  for (size_t i = 0; i < 3; ++i) {
    const double step = (p1[i] - p0[i]) / n[i];
    low[i] = p0[i] - step;
    size[i] = p1[i] - p0[i] + 2 * step;
    if (!(size[i] > 0)) v.reader().report().error(v.where("p1"), "the medium's box is empty");
  }
  VolumeDescription volume;
  volume.where = v.where();
  volume.grid = std::move(grid);
  volume.to_world = v.reader().state().ctm[0] * Matrix4::translate(low[0], low[1], low[2]) *
                    Matrix4::scale(size[0], size[1], size[2]);
  if (size[0] > 0 && size[1] > 0 && size[2] > 0)
    v.reader().check_transform(volume.to_world, v.where());
  SceneDescription& scene = v.reader().scene();
  scene.volumes.push_back(std::move(volume));
  return VolumeId(scene.volumes.size() - 1);
}

MediumDescription read_uniform_grid(Values& v) {
  MediumDescription m = from_sigma(v, read_sigma(v));
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
  return m;
}

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

MediumDescription read_rgb_grid(Values& v) {
  MediumDescription m;
  m.where = v.where();
  m.scale = v.not_negative("scale");
  m.phase = phase(v);
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
  return m;
}

constexpr Spec kNanoVdb[] = {DUET_SIGMA_SPECS,
                             {"filename", kString},
                             {"gridname", kString, "density"},
                             {"preset", kString},
                             {"Lescale", kNumber, "1", "", 1, inert},
                             {"temperaturename", kString, "", "of emission", 1, ignored},
                             {"temperaturegrid", kString, "", "of emission", 1, ignored},
                             {"temperaturescale", kNumber, "1", "of emission", 1, ignored},
                             {"temperatureoffset", kNumber, "0", "of emission", 1, ignored},
                             {"temperaturecutoff", kNumber, "0", "of emission", 1, ignored}};

MediumDescription read_nano_vdb(Values& v) {
  MediumDescription m = from_sigma(v, read_sigma(v));
  const std::string path = v.file("filename");
  if (path.empty()) {
    if (!v.has("filename")) v.reader().report().error(v.where(), "\"string filename\" is needed");
    return m;
  }
  const Spectrum extinction = std::get<Spectrum>(m.sigma_t);
  const bool grey = extinction.r == extinction.g && extinction.g == extinction.b;
  try {
    NanoVdbGrid read = read_nanovdb(path, v.string("gridname"));
    auto grid = std::make_shared<VolumeGrid>(std::move(read.grid));
    if (!grey) {
      grid->channels = 3;
      std::vector<float> colors;
      colors.reserve(grid->values.size() * 3);
      for (const float x : grid->values)
        for (int c = 0; c < 3; ++c) colors.push_back(x * extinction[c]);
      grid->values = std::move(colors);
    }
    VolumeDescription volume;
    volume.where = v.where("filename");
    volume.grid = std::move(grid);
    volume.nodes_on_faces = true;
    volume.to_world = v.reader().state().ctm[0] * read.to_world;
    v.reader().check_transform(volume.to_world, v.where());
    SceneDescription& scene = v.reader().scene();
    if (grey) m.scale *= double(extinction.r);
    m.sigma_t = VolumeId(scene.volumes.size());
    scene.volumes.push_back(std::move(volume));
  } catch (const ReadError& e) {
    v.reader().report().error(v.where("filename"), "{}", e.what());
  }
  return m;
}

#undef DUET_SIGMA_SPECS
#undef DUET_GRID_SPECS

using ReadMedium = MediumDescription (*)(Values&);
constexpr Record<ReadMedium> kMedia[] = {
    {"homogeneous", Versions::both, done, "", kHomogeneous, read_homogeneous},
    {"uniformgrid", Versions::v4, done, "", kUniformGrid, read_uniform_grid},
    {"heterogeneous", Versions::v3, done, "", kUniformGrid, read_uniform_grid},
    {"rgbgrid", Versions::v4, approximated, "between cells the albedo is interpolated", kRgbGrid,
     read_rgb_grid},
    {"cloud", Versions::v4, refused, "noise", {}, nullptr},
    {"nanovdb", Versions::v4, approximated, "without emission by temperature", kNanoVdb,
     read_nano_vdb},
};

}  // namespace

void read_medium(Reader& reader, const Plugin& given) {
  Plugin plugin = given;
  const std::string name = plugin.name;
  std::string type;
  for (size_t i = 0; i < plugin.parameters.size(); ++i)
    if (plugin.parameters[i].name == "type" && !plugin.parameters[i].strings.empty()) {
      type = plugin.parameters[i].strings.front();
      plugin.parameters.erase(plugin.parameters.begin() + std::ptrdiff_t(i));
      break;
    }
  if (type.empty()) {
    reader.report().error(plugin.where, "{} {} has no \"string type\"", plugin.directive,
                          in_quotes(name));
    return;
  }
  plugin.name = type;
  const auto* record = find_record<ReadMedium>(reader, plugin, kMedia);
  if (!record) return;
  if (record->status == Status::approximated)
    reader.approximate(plugin.where, fmt::format("medium {}: {}", record->name, record->note));
  Values v(reader, plugin, record->parameters);
  MediumDescription medium = record->read(v);
  medium.label = {name};
  reader.define_medium(name, std::move(medium));
}

void list_media(std::vector<Row>& rows) {
  list(rows, "MakeNamedMedium", kMedia);
}

}  // namespace duet::pbrt
