// Integrators and accelerators.
#include <algorithm>
#include <numbers>

#include "pbrt/records.h"
#include "pbrt/values.h"
#include "pbrt/vocabulary.h"

namespace duet::pbrt {

namespace {

using enum Status;

#define DUET_PATH_SPECS                                                             \
  {"maxdepth", kInteger, "5", "scattering events"},                                 \
      {"rrthreshold", kNumber, "1", "", 1, inert, Versions::v3},                    \
      {"lightsampler", kString, "",                                                 \
       "bvh, power, uniform or exhaustive; default: bvh if there are many lights"}, \
      {"lightsamplestrategy", kString, "", "the same in v3, or spatial"},           \
      {"regularize", kBoolean, "false", "", 1, ignored}, {                          \
    "pixelbounds", kInteger, "", "", 4, ignored, Versions::v3                       \
  }

constexpr Spec kPath[] = {DUET_PATH_SPECS};
constexpr Spec kSimple[] = {DUET_PATH_SPECS,
                            {"samplebsdf", kBoolean, "true", "", 1, inert},
                            {"samplelights", kBoolean, "true", "", 1, inert}};
constexpr Spec kBdpt[] = {DUET_PATH_SPECS,
                          {"visualizestrategies", kBoolean, "false", "", 1, ignored},
                          {"visualizeweights", kBoolean, "false", "", 1, ignored}};
constexpr Spec kMlt[] = {DUET_PATH_SPECS,
                         {"bootstrapsamples", kInteger, "100000", "", 1, inert},
                         {"chains", kInteger, "1000", "", 1, inert},
                         {"mutationsperpixel", kInteger, "100", "", 1, inert},
                         {"sigma", kNumber, "0.01", "", 1, inert},
                         {"largestepprobability", kNumber, "0.3", "", 1, inert}};
constexpr Spec kSppm[] = {
    DUET_PATH_SPECS,
    {"radius", kNumber, "1"},
    {"photonsperiteration", kInteger, "-1", "-1: as many as pixels"},
    {"iterations", kInteger, "64", "", 1, inert, Versions::v4},
    {"numiterations", kInteger, "64", "", 1, inert, Versions::v4},
    {"iterations", kInteger, "", "instead of the sampler's samples", 1, done, Versions::v3},
    {"numiterations", kInteger, "64", "the same", 1, done, Versions::v3},
    {"imagewritefrequency", kInteger, "1", "", 1, inert},
    {"seed", kInteger, "0", "", 1, inert}};
constexpr Spec kOcclusion[] = {{"maxdistance", kNumber, "", "default: no limit"},
                               {"cossample", kBoolean, "true", "", 1, inert}};
constexpr Spec kOcclusionV3[] = {{"cossample", kBoolean, "true", "", 1, inert},
                                 {"nsamples", kInteger, "64", "", 1, inert},
                                 {"pixelbounds", kInteger, "", "", 4, ignored}};
constexpr Spec kDirect[] = {DUET_PATH_SPECS, {"strategy", kString, "all", "", 1, inert}};

#undef DUET_PATH_SPECS

/// Whether there is something that light passes straight through: what pbrt does not count.
bool has_passing_surfaces(const SceneDescription& scene) {
  for (const MaterialDescription& m : scene.materials)
    if (m.model.is<NullMaterial>() || m.model.is<MaskMaterial>()) return true;
  return false;
}

LightSelection light_selection(Values& v) {
  using enum LightSelection;
  constexpr std::pair<std::string_view, LightSelection> known[] = {
      {"bvh", bvh},         {"exhaustive", bvh},    {"power", power},
      {"uniform", uniform}, {"spatial", automatic}, {"", automatic}};
  const std::string_view parameter = v.has("lightsampler") ? "lightsampler" : "lightsamplestrategy";
  const std::string name = v.string(parameter);
  for (const auto& [word, selection] : known)
    if (name == word) return selection;
  v.reader().report().warning(v.where(parameter),
                              "there is no light sampler {}; lights are chosen as without it",
                              in_quotes(name));
  return automatic;
}

/// `beneath`: light is followed beneath surfaces that have a medium of their own.
PathLimits limits(Values& v, bool beneath) {
  PathLimits limits;
  limits.light_selection = light_selection(v);
  if (beneath) {
    v.reader().approximate(v.where("maxdepth"),
                           "paths of any depth: the limit would count walks beneath surfaces");
    return limits;
  }
  // In segments: one more than scattering events.
  limits.max_depth = std::max(0, v.integer("maxdepth")) + 1;
  return limits;
}

void read_volume_path(Values& v, SceneDescription& scene) {
  scene.integrator.method = VolumePathIntegratorDescription{limits(v, v.reader().has_interiors())};
}

/// Takes all media out of the scene but those beneath surfaces, if these are to be kept.
void drop_media(const Reader& reader, SceneDescription& scene, bool keeps_beneath) {
  for_each_shape(scene, [&](ShapeDescription& s) {
    s.exterior = std::nullopt;
    if (!keeps_beneath || !s.interior || !reader.is_interior(*s.interior))
      s.interior = std::nullopt;
  });
  for (LightDescription& l : scene.lights) l.medium.reset();
  for (SensorDescription& s : scene.sensors) s.medium.reset();
  if (keeps_beneath) return;
  scene.media.clear();
  scene.phases.clear();
  scene.volumes.clear();
}

/// Takes no notice of media, but v3's follows light beneath surfaces.
void read_path(Values& v, SceneDescription& scene) {
  const Reader& reader = v.reader();
  const bool beneath = reader.version() == Version::v3 && reader.has_interiors();
  drop_media(reader, scene, beneath);
  if (beneath || has_passing_surfaces(scene))
    scene.integrator.method = VolumePathIntegratorDescription{limits(v, beneath)};
  else
    scene.integrator.method = PathIntegratorDescription{limits(v, false)};
}

void read_simple_volume_path(Values& v, SceneDescription& scene) {
  for (const ShapeDescription& s : scene.shapes)
    if (!std::holds_alternative<InstanceShape>(s.geometry) &&
        !scene.materials[size_t(s.material)].model.is<NullMaterial>()) {
      v.reader().report().error(v.where(), "simplevolpath allows no surfaces but \"interface\"");
      return;
    }
  read_volume_path(v, scene);
}

BidirectionalIntegratorDescription bidirectional(Values& v, BidirectionalMethod method) {
  BidirectionalIntegratorDescription b;
  b.method = method;
  const PathLimits all = limits(v, v.reader().has_interiors());
  b.max_depth = all.max_depth;
  b.light_selection = all.light_selection;
  return b;
}

void read_bdpt(Values& v, SceneDescription& scene) {
  scene.integrator.method = bidirectional(v, BidirectionalMethod::bdpt);
}

void read_mlt(Values& v, SceneDescription& scene) {
  read_bdpt(v, scene);
}

void read_light_path(Values& v, SceneDescription& scene) {
  scene.integrator.method = bidirectional(v, BidirectionalMethod::ptracer);
}

/// pbrt counts the surfaces that a path from the camera meets until it looks for photons, and those
/// that a photon meets. The sum is that of `limits()` where the former are one.
void warn_of_photon_depth(Values& v, const SceneDescription& scene, int max_depth) {
  constexpr int kNoDifference = 100;
  if (max_depth < 0 || max_depth > kNoDifference) return;
  for (const MaterialDescription& m : scene.materials)
    if (m.model.scattering().has_delta_lobe())
      return v.reader().approximate(
          v.where("maxdepth"),
          fmt::format("in what mirrors and glass show, photons have met fewer surfaces than in "
                      "pbrt: paths have at most {} segments in all",
                      max_depth));
}

/// v3 takes no notice of the sampler.
void read_iterations(Values& v, SceneDescription& scene) {
  const char* name = v.has("iterations") ? "iterations" : "numiterations";
  const int count = v.integer(name);
  if (count < 1)
    return v.reader().report().error(v.where(name), "the number of iterations cannot be {}", count);
  for (SensorDescription& s : scene.sensors) s.sampler.sample_count = count;
}

void read_sppm(Values& v, SceneDescription& scene) {
  BidirectionalIntegratorDescription b = bidirectional(v, BidirectionalMethod::ppm);
  b.radius = v.positive("radius");
  const int photons = v.integer("photonsperiteration");
  for (const SensorDescription& s : scene.sensors)
    if (photons > 0) b.light_paths = photons / (double(s.film.width) * s.film.height);
  scene.integrator.method = b;
  if (v.reader().options().replaces_integrator) return;
  if (v.reader().version() == Version::v3) read_iterations(v, scene);
  warn_of_photon_depth(v, scene, b.max_depth);
}

/// Further than any scene is wide.
constexpr double kNoLimit = 1e15;

void read_occlusion(Values& v, SceneDescription& scene) {
  OcclusionIntegratorDescription o;
  o.background = false;
  o.ray_length = v.has("maxdistance") ? v.positive("maxdistance") : kNoLimit;
  scene.integrator.method = o;
}

/// v3's sum of cosines lacks the division by π: where nothing is in the way it is π. The film
/// multiplies by it, as by its own scale.
void read_occlusion_v3(Values& v, SceneDescription& scene) {
  OcclusionIntegratorDescription o;
  o.background = false;
  o.ray_length = kNoLimit;
  scene.integrator.method = o;
  if (v.reader().options().replaces_integrator) return;
  const auto brighten = [](ColorMatrix& m) {
    for (auto& row : m)
      for (double& x : row) x *= std::numbers::pi;
  };
  for (SensorDescription& s : scene.sensors) {
    if (!s.film.response) s.film.response = FilmResponse{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    brighten(*s.film.response);
    if (s.film.sample_limit) brighten(s.film.sample_limit->sensor);
  }
}

/// Direct light on surfaces, and on those that smooth ones show.
void read_direct(Values& v, SceneDescription& scene) {
  PathIntegratorDescription direct{limits(v, false)};
  direct.only_specular = true;
  // What light passes straight through would count.
  if (has_passing_surfaces(scene)) direct.max_depth = -1;
  scene.integrator.method = direct;
  drop_media(v.reader(), scene, false);
}

using ReadIntegrator = void (*)(Values&, SceneDescription&);
constexpr Record<ReadIntegrator> kIntegrators[] = {
    {"volpath", Versions::both, done, "", kPath, read_volume_path},
    {"path", Versions::both, done,
     "media are not seen, as in pbrt; what is beneath surfaces is in v3", kPath, read_path},
    {"simplepath", Versions::v4, done, "as path", kSimple, read_path},
    {"randomwalk", Versions::v4, approximated, "as path, which sees lights without extent, too",
     kSimple, read_path},
    {"simplevolpath", Versions::v4, done, "as volpath", kSimple, read_simple_volume_path},
    {"bdpt", Versions::both, done, "", kBdpt, read_bdpt},
    {"mlt", Versions::both, approximated, "by bdpt, which has the same mean", kMlt, read_mlt},
    {"lightpath", Versions::v4, done, "", kPath, read_light_path},
    {"sppm", Versions::both, done, "", kSppm, read_sppm},
    {"ambientocclusion", Versions::v4, done, "", kOcclusion, read_occlusion},
    {"ao", Versions::v3, done, "", kOcclusionV3, read_occlusion_v3},
    {"directlighting", Versions::v3, done, "what is beneath surfaces is not seen", kDirect,
     read_direct},
    {"whitted", Versions::v3, done, "what is beneath surfaces is not seen", kDirect, read_direct},
    {"function", Versions::v4, refused, "it draws a function, not a scene", {}, nullptr},
};

constexpr Spec kBvh[] = {{"maxnodeprims", kInteger, "4", "", 1, inert},
                         {"splitmethod", kString, "sah", "", 1, inert}};
constexpr Spec kKdTree[] = {{"intersectcost", kInteger, "5", "", 1, inert},
                            {"traversalcost", kInteger, "1", "", 1, inert},
                            {"emptybonus", kNumber, "0.5", "", 1, inert},
                            {"maxprims", kInteger, "1", "", 1, inert},
                            {"maxdepth", kInteger, "-1", "", 1, inert}};
constexpr Record<int> kAccelerators[] = {{"bvh", Versions::both, inert, "", kBvh, 1},
                                         {"kdtree", Versions::both, inert, "", kKdTree, 1}};

}  // namespace

void check_accelerator(Reader& reader, const Plugin& plugin) {
  const bool known = std::any_of(std::begin(kAccelerators), std::end(kAccelerators),
                                 [&](const auto& r) { return r.name == plugin.name; });
  if (!known && reader.version() == Version::v3)
    reader.report().warning(plugin.where,
                            "there is no Accelerator {}; it is ignored, as in pbrt-v3",
                            in_quotes(plugin.name));
  else if (const auto* record = find_record<int>(reader, plugin, kAccelerators))
    Values(reader, plugin, record->parameters);
}

void finish_integrator(Reader& reader) {
  Plugin standard{"Integrator", reader.version() == Version::v3 ? "path" : "volpath", {}, {}};
  standard.where = {std::make_shared<const std::string>(reader.scene().file), 0, 0};
  const Plugin& plugin = reader.integrator ? *reader.integrator : standard;
  reader.scene().integrator.where = plugin.where;
  reader.scene().counts_passed_surfaces = false;
  const bool replaced = reader.options().replaces_integrator;
  const Record<ReadIntegrator>* record = nullptr;
  {
    Report::Mute mute(reader.report(), replaced);
    record = find_record<ReadIntegrator>(reader, plugin, kIntegrators);
  }
  if (!record && replaced) record = &kIntegrators[0];
  if (!record) return;
  if (record->status == approximated && !replaced)
    reader.approximate(plugin.where, fmt::format("integrator {}: {}", record->name, record->note));
  Values v(reader, plugin, record->parameters);
  record->read(v, reader.scene());
}

void list_integrators(std::vector<Row>& rows) {
  list(rows, "Integrator", kIntegrators);
  list(rows, "Accelerator", kAccelerators);
}

}  // namespace duet::pbrt
