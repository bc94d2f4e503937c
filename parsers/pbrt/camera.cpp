// The camera with its film, filter and sampler.
#include "pbrt/camera.h"

#include <algorithm>
#include <cmath>

#include "math/angles.h"
#include "pbrt/film.h"
#include "pbrt/records.h"
#include "pbrt/vocabulary.h"

namespace duet::pbrt {

namespace {

using enum Status;

/// The part of the camera's plane that the film shows.
struct Window {
  double x0, x1, y0, y1;
  /// -1 if the picture is turned over: the numbers are those of the mirrored camera then.
  double mirror_x = 1, mirror_y = 1;
};

#define DUET_CAMERA_SPECS                                                             \
  {"shutteropen", kNumber, "0"}, {"shutterclose", kNumber, "1"},                      \
      {"frameaspectratio", kNumber, "", "width over height; default: of the film"}, { \
    "screenwindow", kNumber, "", "left, right, bottom and top", 4                     \
  }
#define DUET_LENS_SPECS             \
  {"lensradius", kNumber, "0"}, {   \
    "focaldistance", kNumber, "1e6" \
  }

constexpr Spec kPerspective[] = {{"fov", kNumber, "90", "degrees, along the film's shorter side"},
                                 {"halffov", kNumber, "", "", 1, done, Versions::v3},
                                 DUET_LENS_SPECS,
                                 DUET_CAMERA_SPECS};
constexpr Spec kOrthographic[] = {DUET_LENS_SPECS, DUET_CAMERA_SPECS};
constexpr Spec kSpherical[] = {
    {"mapping", kString, "equalarea", "equalarea or equirectangular", 1, done, Versions::v4},
    DUET_CAMERA_SPECS};

Window window(Values& v, const FilmDescription& film) {
  if (v.has("screenwindow")) {
    const auto w = v.numbers("screenwindow");
    if (w[0] != w[1] && w[2] != w[3]) {
      const auto [left, right] = std::minmax(w[0], w[1]);
      const auto [bottom, top] = std::minmax(w[2], w[3]);
      if (v.reader().version() == Version::v4) return {left, right, bottom, top};
      // v3 does not sort the two of each side.
      const double x = w[0] > w[1] ? -1 : 1, y = w[2] > w[3] ? -1 : 1;
      return {x * w[0], x * w[1], y * w[2], y * w[3], x, y};
    }
    v.reader().report().error(v.where("screenwindow"), "the screen window is empty");
  }
  const double aspect =
      v.has("frameaspectratio") ? v.positive("frameaspectratio") : double(film.width) / film.height;
  if (aspect > 1) return {-aspect, aspect, -1, 1};
  return {-1, 1, -1 / aspect, 1 / aspect};
}

/// How many times as high as wide the window's pixels are.
double pixel_aspect(const Window& w, const FilmDescription& film) {
  const double ratio = (w.y1 - w.y0) * film.width / ((w.x1 - w.x0) * film.height);
  return std::abs(ratio - 1) < 1e-6 ? 1 : ratio;
}

/// Rays begin at the camera and go on.
void no_clipping(SensorDescription& sensor) {
  sensor.near_clip = 1e-5;
  sensor.far_clip = 1e15;
}

void read_perspective(Values& v, SensorDescription& sensor) {
  Report& report = v.reader().report();
  double fov = v.number("fov");
  if (v.has("halffov")) fov = 2 * v.number("halffov");
  if (!(fov > 0 && fov < 180)) {
    report.error(v.where("fov"), "a field of view lies between 0 and 180 degrees, not at {}", fov);
    fov = 90;
  }
  const Window w = window(v, sensor.film);
  const double stretch = pixel_aspect(w, sensor.film), width = w.x1 - w.x0, height = w.y1 - w.y0;
  const double half_width = 0.5 * width * std::tan(0.5 * fov * kRadians);
  sensor.kind = SensorKind::perspective;
  sensor.fov = 2 * std::atan(half_width) / kRadians;
  sensor.fov_axis = FovAxis::x;
  sensor.principal_point_offset_x = 0.5 + w.x0 / width;
  sensor.principal_point_offset_y = 0.5 - w.y1 / height;
  if (const double radius = v.not_negative("lensradius"); radius > 0) {
    sensor.kind = SensorKind::thinlens;
    sensor.aperture_radius = radius;
    sensor.focus_distance = v.positive("focaldistance");
    sensor.aperture_aspect = 1 / stretch;
  }
  no_clipping(sensor);
  place_camera(sensor, v.reader(), Matrix4::scale(-w.mirror_x, w.mirror_y * stretch, 1));
}

void read_orthographic(Values& v, SensorDescription& sensor) {
  const Window w = window(v, sensor.film);
  const double stretch = pixel_aspect(w, sensor.film), half = 0.5 * (w.x1 - w.x0);
  sensor.kind = SensorKind::orthographic;
  if (const double radius = v.not_negative("lensradius"); radius > 0) {
    sensor.kind = SensorKind::telecentric;
    const double scale = std::cbrt(std::abs(v.reader().camera_state.ctm[0].determinant3()));
    sensor.aperture_radius = radius * scale;
    sensor.focus_distance = v.positive("focaldistance") * scale;
  }
  no_clipping(sensor);
  place_camera(sensor, v.reader(),
               Matrix4::scale(w.mirror_x, w.mirror_y, 1) *
                   Matrix4::translate(0.5 * (w.x0 + w.x1), 0.5 * (w.y0 + w.y1), 0) *
                   Matrix4::scale(-half, half * stretch, 1));
}

void read_spherical(Values& v, SensorDescription& sensor) {
  const bool v3 = v.reader().version() == Version::v3;
  const std::string mapping = v3 ? "equirectangular" : v.string("mapping");
  sensor.kind = SensorKind::spherical;
  if (mapping == "equalarea")
    sensor.sphere_mapping = SphereMapping::equal_area;
  else if (mapping != "equirectangular")
    v.reader().report().error(v.where("mapping"),
                              "a spherical camera's mapping is equalarea or equirectangular");
  no_clipping(sensor);
  // The first column shows pbrt's +x, and the columns go on to +z.
  Matrix4 turn;
  turn.m = {{{0, 0, -1, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}, {0, 0, 0, 1}}};
  place_camera(sensor, v.reader(), turn);
}

constexpr Spec kRealistic[] = {
    {"lensfile", kString, "", "radius, thickness, refractive index and diameter of each surface"},
    {"aperturediameter", kNumber, "1", "of the stop, in mm"},
    {"focusdistance", kNumber, "10", "from the film"},
    {"aperture", kString, "", "gaussian, square, pentagon, star or an image", 1, done,
     Versions::v4},
    {"simpleweighting", kBoolean, "true", "brightness does not depend on the lens", 1, done,
     Versions::v3},
    DUET_CAMERA_SPECS};

#undef DUET_CAMERA_SPECS
#undef DUET_LENS_SPECS

using ReadCamera = void (*)(Values&, SensorDescription&);
constexpr Record<ReadCamera> kCameras[] = {
    {"perspective", Versions::both, done, "", kPerspective, read_perspective},
    {"orthographic", Versions::both, done, "", kOrthographic, read_orthographic},
    {"spherical", Versions::v4, done, "", kSpherical, read_spherical},
    {"environment", Versions::v3, done, "", kSpherical, read_spherical},
    {"realistic", Versions::both, done, "rays are traced through the lenses, without their colours",
     kRealistic, read_realistic},
};

constexpr Spec kSampler[] = {
    {"pixelsamples", kInteger, "16"},
    {"seed", kInteger, "0", "", 1, inert},
    {"randomization", kString, "fastowen", "", 1, inert},
    {"xsamples", kInteger, "4"},
    {"ysamples", kInteger, "4"},
    {"jitter", kBoolean, "true", "", 1, inert},
    {"dimensions", kInteger, "4", "", 1, inert},
    {"scramble", kBoolean, "true", "", 1, inert},
    {"samplepixelcenter", kBoolean, "false", "", 1, inert, Versions::v3},
};

constexpr Record<int> kSamplers[] = {
    {"zsobol", Versions::v4, inert, "", kSampler, 1},
    {"paddedsobol", Versions::v4, inert, "", kSampler, 1},
    {"sobol", Versions::both, inert, "", kSampler, 1},
    {"halton", Versions::both, inert, "", kSampler, 1},
    {"independent", Versions::v4, inert, "", kSampler, 1},
    {"pmj02bn", Versions::v4, inert, "", kSampler, 1},
    {"stratified", Versions::both, inert, "", kSampler, 1},
    {"random", Versions::v3, inert, "", kSampler, 1},
    {"lowdiscrepancy", Versions::v3, inert, "", kSampler, 1},
    {"02sequence", Versions::v3, inert, "", kSampler, 1},
    {"zerotwosequence", Versions::v3, inert, "", kSampler, 1},
    {"maxmindist", Versions::v3, inert, "", kSampler, 1},
};

void read_sampler(Reader& reader, SensorDescription& sensor) {
  sensor.sampler.sample_count = 16;
  if (!reader.sampler) return;
  const auto* record = find_record<int>(reader, *reader.sampler, kSamplers);
  if (!record) return;
  Values v(reader, *reader.sampler, record->parameters);
  sensor.sampler.name = record->name;
  double count = v.number("pixelsamples");
  if (record->name == "stratified") count = v.number("xsamples") * v.number("ysamples");
  if (count >= 1 && count <= 1e9)
    sensor.sampler.sample_count = int(count);
  else
    reader.report().error(reader.sampler->where, "the number of samples cannot be {}", count);
}

}  // namespace

void place_camera(SensorDescription& sensor, Reader& reader, const Matrix4& to_camera) {
  const auto& ctm = reader.camera_state.ctm;
  if (ctm[0] == ctm[1]) {
    sensor.to_world = ctm[0] * to_camera;
    return;
  }
  sensor.to_world = to_camera;
  sensor.motion =
      Motion({{reader.transform_times[0], ctm[0]}, {reader.transform_times[1], ctm[1]}});
}

void finish_camera(Reader& reader) {
  SensorDescription sensor;
  Plugin standard{"Camera", "perspective", {}, {}};
  standard.where = {std::make_shared<const std::string>(reader.scene().file), 0, 0};
  if (!reader.camera)
    reader.report().warning(standard.where, "there is no Camera: pbrt's default is taken");
  const Plugin& plugin = reader.camera ? *reader.camera : standard;
  sensor.where = plugin.where;
  read_sampler(reader, sensor);
  const auto* record = find_record<ReadCamera>(reader, plugin, kCameras);
  if (!record) return;
  Values v(reader, plugin, record->parameters);
  const double open = v.number("shutteropen"), close = v.number("shutterclose");
  if (close < open || (close == open && reader.version() == Version::v4))
    reader.report().error(v.where("shutterclose"), "the shutter closes before it opens");
  read_film(reader, sensor, close - open);
  record->read(v, sensor);
  sensor.shutter = {open, close};
  sensor.medium = reader.camera_state.outside;
  reader.scene().sensors.push_back(std::move(sensor));
}

void list_cameras(std::vector<Row>& rows) {
  list(rows, "Camera", kCameras);
  list(rows, "Sampler", kSamplers);
}

}  // namespace duet::pbrt
