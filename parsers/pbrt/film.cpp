#include "pbrt/film.h"

#include <algorithm>
#include <cmath>

#include "pbrt/records.h"
#include "pbrt/values.h"
#include "pbrt/vocabulary.h"
#include "values/text.h"

namespace duet::pbrt {

namespace {

using enum Status;

#define DUET_FILM_SPECS                                                                             \
  {"xresolution", kInteger, "1280"}, {"yresolution", kInteger, "720"},                              \
      {"cropwindow", kNumber, "", "left, right, top and bottom, as shares", 4},                     \
      {"pixelbounds", kInteger, "", "the same in pixels", 4, done, Versions::v4},                   \
      {"filename", kString, "", "", 1, inert},                                                      \
      {"diagonal", kNumber, "35", "in mm; of realistic cameras"},                                   \
      {"maxcomponentvalue", kNumber, "", "what a sample may bring at most", 1, done, Versions::v4}, \
      {"maxsampleluminance", kNumber, "", "the luminance that a sample may bring at most", 1, done, \
       Versions::v3},                                                                               \
  {                                                                                                 \
    "savefp16", kBoolean, "true", "half or single precision in EXR files"                           \
  }

constexpr Spec kRgbFilm[] = {
    DUET_FILM_SPECS,
    {"iso", kNumber, "100"},
    {"whitebalance", kNumber, "0", "kelvin; 0: none"},
    {"sensor", kString, "cie1931", "others than cie1931 are approximated by it"},
    {"exposuretime", kNumber, "1", "", 1, ignored},
};
constexpr Spec kGbufferFilm[] = {
    DUET_FILM_SPECS,
    {"iso", kNumber, "100"},
    {"whitebalance", kNumber, "0"},
    {"sensor", kString, "cie1931"},
    {"coordinatesystem", kString, "camera", "of P, N, Ns, dzdx and dzdy: camera or world"},
};
constexpr Spec kSpectralFilm[] = {
    DUET_FILM_SPECS,
    {"iso", kNumber, "100"},
    {"whitebalance", kNumber, "0"},
    {"sensor", kString, "cie1931"},
    {"nbuckets", kInteger, "16", "", 1, inert},
    {"lambdamin", kNumber, "", "", 1, inert},
    {"lambdamax", kNumber, "", "", 1, inert},
};
constexpr Spec kImageFilm[] = {DUET_FILM_SPECS, {"scale", kNumber, "1"}};

#undef DUET_FILM_SPECS

constexpr std::string_view kSensors[] = {
    "canon_eos_100d", "canon_eos_1dx_mkii", "canon_eos_200d_mkii", "canon_eos_200d",
    "canon_eos_5d",   "canon_eos_5d_mkii",  "canon_eos_5d_mkiii",  "canon_eos_5d_mkiv",
    "canon_eos_5ds",  "canon_eos_m",        "hasselblad_l1d_20c",  "nikon_d810",
    "nikon_d850",     "sony_ilce_6400",     "sony_ilce_7m3",       "sony_ilce_7rm3",
    "sony_ilce_9"};

/// What is cut off samples: in v4 by their XYZ after the exposure, in v3 by their luminance.
void read_limit(Values& v, FilmDescription& film, double scale) {
  const bool v3 = v.reader().version() == Version::v3;
  const char* name = v3 ? "maxsampleluminance" : "maxcomponentvalue";
  if (!v.has(name)) return;
  SampleLimit limit;
  limit.most = v.positive(name);
  limit.sensor = to_xyz(v.reader().film_color_space);
  if (v3) limit.sensor[0] = limit.sensor[2] = limit.sensor[1];
  for (auto& row : limit.sensor)
    for (double& x : row) x *= v3 ? 1 : scale;
  film.sample_limit = limit;
}

/// What the film makes of colours: exposure, white balance and its colour space.
void read_response(Values& v, FilmDescription& film, double exposure_time) {
  Reader& reader = v.reader();
  Matrix3 response{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  double scale = 1;
  if (v.plugin().name == "image") {
    scale = v.number("scale");
  } else {
    scale = exposure_time * v.positive("iso") / 100;
    const std::string sensor = v.string("sensor");
    double kelvin = v.not_negative("whitebalance");
    if (sensor != "cie1931") {
      const std::vector<std::string> known(std::begin(kSensors), std::end(kSensors));
      if (std::find(known.begin(), known.end(), sensor) == known.end())
        reader.report().error(v.where("sensor"), "there is no sensor {}{}", in_quotes(sensor),
                              did_you_mean(sensor, known));
      reader.approximate(v.where("sensor"), "sensor " + sensor + " by the standard observer");
    }
    if (kelvin > 0) response = white_balance(kelvin, reader.film_color_space);
  }
  read_limit(v, film, scale);
  for (auto& row : response)
    for (double& x : row) x *= scale;
  const Matrix3 none{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  if (response != none) film.response = response;
}

void read_crop(Values& v, FilmDescription& film) {
  std::array<double, 4> bounds{0, double(film.width), 0, double(film.height)};
  const auto set = [&](size_t axis, double size, double a, double b) {
    bounds[axis] = std::clamp(std::min(a, b), 0.0, size);
    bounds[axis + 1] = std::clamp(std::max(a, b), 0.0, size);
  };
  if (v.has("cropwindow")) {
    const auto c = v.numbers("cropwindow");
    // pbrt computes them in single precision.
    const auto pixel = [](double share, int size) {
      return double(std::ceil(float(size) * float(share)));
    };
    set(0, film.width, pixel(c[0], film.width), pixel(c[1], film.width));
    set(2, film.height, pixel(c[2], film.height), pixel(c[3], film.height));
  } else if (v.has("pixelbounds")) {
    const auto p = v.numbers("pixelbounds");
    set(0, film.width, p[0], p[1]);
    set(2, film.height, p[2], p[3]);
  } else {
    return;
  }
  if (bounds[0] >= bounds[1] || bounds[2] >= bounds[3]) {
    v.reader().report().error(v.where(), "the film's window is empty");
    return;
  }
  film.crop = CropWindow{int(bounds[0]), int(bounds[2]), int(bounds[1] - bounds[0]),
                         int(bounds[3] - bounds[2])};
}

constexpr Record<int> kFilms[] = {
    {"rgb", Versions::v4, done, "", kRgbFilm, 1},
    {"gbuffer", Versions::v4, done,
     "the layers Albedo, P, uv, dzdx, dzdy, N, Ns, Variance and RelativeVariance; dzdx and dzdy "
     "have signs and are per pixel, where pbrt divides them by the root of the samples per pixel; "
     "variances are of colours and count samples that see no surface",
     kGbufferFilm, 1},
    {"spectral", Versions::v4, approximated, "by its colours alone", kSpectralFilm, 1},
    {"image", Versions::v3, done, "", kImageFilm, 1},
};

#define DUET_RADIUS_SPECS(preset)                               \
  {"xradius", kNumber, preset}, {"yradius", kNumber, preset},   \
      {"xwidth", kNumber, preset, "", 1, done, Versions::v3}, { \
    "ywidth", kNumber, preset, "", 1, done, Versions::v3        \
  }

constexpr Spec kBox[] = {DUET_RADIUS_SPECS("0.5")};
constexpr Spec kTriangle[] = {DUET_RADIUS_SPECS("2")};
constexpr Spec kGaussianV4[] = {DUET_RADIUS_SPECS("1.5"), {"sigma", kNumber, "0.5"}};
constexpr Spec kGaussianV3[] = {DUET_RADIUS_SPECS("2"), {"alpha", kNumber, "2"}};
constexpr Spec kMitchell[] = {DUET_RADIUS_SPECS("2"),
                              {"B", kNumber, "0.3333333333333333"},
                              {"C", kNumber, "0.3333333333333333"}};
constexpr Spec kSinc[] = {DUET_RADIUS_SPECS("4"), {"tau", kNumber, "3"}};

#undef DUET_RADIUS_SPECS

constexpr Record<FilterKind> kFilters[] = {
    {"box", Versions::both, done, "", kBox, FilterKind::box},
    {"triangle", Versions::both, done, "", kTriangle, FilterKind::tent},
    {"gaussian", Versions::v4, done, "", kGaussianV4, FilterKind::gaussian},
    {"gaussian", Versions::v3, done, "", kGaussianV3, FilterKind::gaussian},
    {"mitchell", Versions::both, done, "", kMitchell, FilterKind::mitchell},
    {"sinc", Versions::both, done, "", kSinc, FilterKind::lanczos},
};

void read_filter(Reader& reader, FilmDescription& film) {
  Plugin standard{"PixelFilter", reader.version() == Version::v3 ? "box" : "gaussian", {}, {}};
  const Plugin& plugin = reader.filter ? *reader.filter : standard;
  const Record<FilterKind>* record = nullptr;
  for (const auto& r : kFilters)
    if (r.name == plugin.name && has_version(r.versions, reader.version())) record = &r;
  if (!record) {
    std::vector<std::string> names;
    for (const auto& r : kFilters) names.emplace_back(r.name);
    reader.report().error(plugin.where, "there is no {} {}{}", plugin.directive,
                          in_quotes(plugin.name), did_you_mean(plugin.name, names));
    return;
  }
  Values v(reader, plugin, record->parameters);
  FilterDescription& f = film.filter;
  f.kind = record->read;
  const auto radius = [&](const char* name, const char* old) {
    const bool is_old = reader.version() == Version::v3 && v.has(old);
    const double r = v.positive(is_old ? old : name);
    constexpr double kLargest = 30;
    if (r <= kLargest) return r;
    reader.report().error(plugin.where, "a filter's radius of {} pixels is too large", r);
    return 1.0;
  };
  f.reach_x = radius("xradius", "xwidth");
  f.reach_y = radius("yradius", "ywidth");
  if (f.kind == FilterKind::gaussian)
    f.stddev = reader.version() == Version::v4 ? v.positive("sigma")
                                               : 1 / std::sqrt(2 * v.positive("alpha"));
  if (f.kind == FilterKind::mitchell) f.b = v.number("B"), f.c = v.number("C");
  if (f.kind == FilterKind::lanczos) {
    const double tau = v.positive("tau");
    f.lobes = std::max(1, int(std::lround(tau)));
    if (f.lobes != tau) reader.approximate(v.where("tau"), "a sinc filter's tau by an integer");
  }
  // The box of one pixel has a form of its own.
  if (f.kind == FilterKind::box && f.reach_x == f.reach_y) {
    f.radius = *f.reach_x;
    f.reach_x = f.reach_y = std::nullopt;
  }
}

/// The layers of a gbuffer.
void add_layers(Values& v, AovDescription& aovs) {
  const std::string system = v.string("coordinatesystem");
  const auto& ctm = v.reader().camera_state.ctm;
  if (system == "camera") {
    aovs.frame = ctm[0].inverse().value_or(Matrix4());
    if (!(ctm[0] == ctm[1]))
      v.reader().approximate(
          v.where(),
          "layers in the coordinates of a camera that moves are in those of its first pose");
  }
  if (system != "camera" && system != "world")
    v.reader().report().error(v.where("coordinatesystem"),
                              "a gbuffer's coordinate system is camera or world, not {}",
                              in_quotes(system));
  aovs.layers = {{"albedo", "Albedo"},
                 {"position", "P"},
                 {"uv", "uv"},
                 {"dz_dx", "dzdx"},
                 {"dz_dy", "dzdy"},
                 {"geo_normal", "N"},
                 {"sh_normal", "Ns"},
                 {"sample_variance", "Variance"},
                 {"relative_variance", "RelativeVariance"}};
  for (AovDescription::Layer& layer : aovs.layers) layer.in_frame = true;
}

}  // namespace

void read_film(Reader& reader, SensorDescription& sensor, double exposure_time) {
  FilmDescription& film = sensor.film;
  Plugin standard{"Film", reader.version() == Version::v3 ? "image" : "rgb", {}, {}};
  const Plugin& plugin = reader.film ? *reader.film : standard;
  film.where = plugin.where;
  read_filter(reader, film);
  const auto* record = find_record<int>(reader, plugin, kFilms);
  if (!record || !record->read) return;
  if (record->status == approximated)
    reader.approximate(plugin.where, fmt::format("film {} {}", record->name, record->note));
  Values v(reader, plugin, record->parameters);
  constexpr int kLargest = 65536;
  const auto size = [&](const char* name) {
    const int n = v.integer(name);
    if (n >= 1 && n <= kLargest) return n;
    reader.report().error(v.where(name), "a film cannot have {} pixels along a side", n);
    return 16;
  };
  film.width = size("xresolution");
  film.height = size("yresolution");
  if (reader.version() == Version::v3 || !v.boolean("savefp16"))
    film.component_format = ComponentFormat::single;
  sensor.lenses.film_diagonal = 1e-3 * v.positive("diagonal");
  if (record->name == "gbuffer") add_layers(v, reader.scene().integrator.aovs);
  read_crop(v, film);
  read_response(v, film, exposure_time);
}

void list_films(std::vector<Row>& rows) {
  list(rows, "Film", kFilms);
  list(rows, "PixelFilter", kFilters);
}

}  // namespace duet::pbrt
