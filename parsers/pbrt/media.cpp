// Participating media.
#include "pbrt/media.h"

#include <algorithm>
#include <cmath>

#include "pbrt/records.h"
#include "pbrt/vocabulary.h"
#include "values/medium_presets.h"
#include "values/text.h"

namespace duet::pbrt {

namespace {

struct Sigma {
  Spectrum absorption, scattering;
};

Sigma read_sigma(Values& v) {
  Sigma s{v.color("sigma_a", ColorMeaning::unbounded), v.color("sigma_s", ColorMeaning::unbounded)};
  if (!v.has("preset")) return s;
  const std::string name = v.string("preset");
  if (const MediumPreset* preset = find_medium_preset(name)) {
    // In v3 it is only what coefficients are that are not given.
    const bool v3 = v.reader().version() == Version::v3;
    if (!v3 || !v.has("sigma_a")) s.absorption = preset->sigma_a;
    if (!v3 || !v.has("sigma_s")) s.scattering = preset->sigma_s;
    return s;
  }
  v.reader().report().warning(v.where("preset"), "{}; the coefficients hold, as in pbrt",
                              no_medium_preset(name));
  return s;
}

}  // namespace

PhaseId read_phase(Values& v) {
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

MediumDescription medium_from_sigma(Values& v) {
  const Sigma s = read_sigma(v);
  MediumDescription m;
  m.where = v.where();
  m.label = {v.plugin().name};
  const Spectrum extinction = s.absorption + s.scattering;
  Spectrum albedo;
  for (int c = 0; c < 3; ++c) albedo[c] = extinction[c] > 0 ? s.scattering[c] / extinction[c] : 0;
  m.sigma_t = extinction;
  m.albedo = albedo;
  m.scale = v.not_negative("scale");
  m.phase = read_phase(v);
  return m;
}

MediumDescription read_homogeneous(Values& v) {
  MediumDescription m = medium_from_sigma(v);
  m.emission = read_constant_emission(v);
  return m;
}

MediumDescription read_cloud(Values& v) {
  MediumDescription m = medium_from_sigma(v);
  CloudDescription cloud;
  cloud.density = v.not_negative("density");
  cloud.wispiness = v.not_negative("wispiness");
  cloud.frequency = v.number("frequency");
  cloud.lower = v.point("p0");
  cloud.upper = v.point("p1");
  cloud.to_world = v.reader().state().ctm[0];
  for (size_t i = 0; i < 3; ++i)
    if (!(cloud.lower[i] < cloud.upper[i]))
      v.reader().report().error(v.where("p1"), "the medium's box is empty");
  v.reader().check_transform(cloud.to_world, v.where());
  m.cloud = cloud;
  return m;
}

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

#define DUET_TEMPERATURE_SPECS                                                                   \
  {"temperaturescale", kNumber, "1"}, {"temperatureoffset", kNumber, "0", "taken off before"}, { \
    "temperaturecutoff", kNumber, "0", "the same by another name"                                \
  }

constexpr Spec kHomogeneous[] = {DUET_SIGMA_SPECS,
                                 {"preset", kString},
                                 {"Le", kColor, "0", "radiance that absorbing parts emit"},
                                 {"Lescale", kNumber, "1"}};
constexpr Spec kUniformGrid[] = {
    DUET_SIGMA_SPECS,
    DUET_GRID_SPECS,
    {"density", kNumber, "", "x fastest, then y, then z", 0},
    {"preset", kString},
    {"Le", kColor, "0", "radiance that absorbing parts emit"},
    {"Lescale", kNumber, "1", "per cell", 0},
    {"temperature", kNumber, "", "kelvin per cell: emits as black bodies", 0},
    DUET_TEMPERATURE_SPECS};
constexpr Spec kRgbGrid[] = {{"sigma_a", kColor, "1", "per cell", 0},
                             {"sigma_s", kColor, "1", "per cell", 0},
                             {"scale", kNumber, "1"},
                             {"g", kNumber, "0"},
                             {"Le", kColor, "", "emission per cell", 0},
                             {"Lescale", kNumber, "1"},
                             DUET_GRID_SPECS};
constexpr Spec kNanoVdb[] = {
    DUET_SIGMA_SPECS,
    {"filename", kString},
    {"gridname", kString, "density"},
    {"preset", kString},
    {"Lescale", kNumber, "1"},
    {"LeScale", kNumber, "1", "the same by another name"},
    {"temperaturename", kString, "temperature", "grid of kelvin, if the file has it"},
    DUET_TEMPERATURE_SPECS};
constexpr Spec kCloud[] = {DUET_SIGMA_SPECS,
                           {"p0", kPoint3, "0 0 0"},
                           {"p1", kPoint3, "1 1 1"},
                           {"density", kNumber, "1", "multiplies the noise"},
                           {"wispiness", kNumber, "1", "how far noise displaces the noise"},
                           {"frequency", kNumber, "5", "of the noise"}};

#undef DUET_TEMPERATURE_SPECS
#undef DUET_SIGMA_SPECS
#undef DUET_GRID_SPECS

using ReadMedium = MediumDescription (*)(Values&);
constexpr Record<ReadMedium> kMedia[] = {
    {"homogeneous", Versions::both, done, "", kHomogeneous, read_homogeneous},
    {"uniformgrid", Versions::v4, done, "", kUniformGrid, read_uniform_grid},
    {"heterogeneous", Versions::v3, done, "", kUniformGrid, read_uniform_grid},
    {"rgbgrid", Versions::v4, approximated, "between cells the albedo is interpolated", kRgbGrid,
     read_rgb_grid},
    {"cloud", Versions::v4, done, "", kCloud, read_cloud},
    {"nanovdb", Versions::v4, done, "", kNanoVdb, read_nano_vdb},
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
