// Every weight that a connection gets against the definition, on the paths that sub-paths really
// make.
#include <array>
#include <cmath>

#include "support/light_oracle.h"
#include "support/mis_oracle.h"
#include "support/transport_scene.h"
#include "transport/light_subpath.h"
#include "transport/weights.h"

using namespace duet;
using namespace duet::test;

namespace {

constexpr float kGlass = 1.5f;

std::string holes_xml() {
  return "<bsdf type='mask'><float name='opacity' value='0.6'/>" + grey("0.5, 0.5, 0.5") +
         "</bsdf>";
}

/// Rooms with everything that sub-paths can meet; `lens` for a camera with an aperture.
std::vector<std::string> scenes() {
  const std::string grey_walls = room_xml(grey("0.7, 0.5, 0.3"));
  const std::string glass =
      "<bsdf type='dielectric'><float name='int_ior' value='1.5'/>"
      "<float name='ext_ior' value='1'/></bsdf>";
  const std::string rough_glass =
      "<bsdf type='roughdielectric'><float name='alpha' value='0.3'/>"
      "<float name='int_ior' value='1.5'/><float name='ext_ior' value='1'/></bsdf>";
  const std::string mirror = "<bsdf type='conductor'/>";
  const std::string rough_metal =
      "<bsdf type='roughconductor'><float name='alpha' value='0.2'/></bsdf>";
  const std::string plastic = "<bsdf type='plastic'/>";
  const std::string holes = holes_xml();
  const std::string camera = camera_xml("0, -3, 1", "0, 0, 1", 32);
  const std::string lens = camera_xml(
      "0.3, -3, 1.2", "0, 0, 1", 32, "thinlens",
      "<float name='aperture_radius' value='0.1'/><float name='focus_distance' value='3'/>");
  const std::string ortho =
      "<sensor type='orthographic'><transform name='to_world'><scale value='1.1'/>"
      "<lookat origin='0,-3,1' target='0,0,1' up='0,0,1'/></transform><film type='hdrfilm'>"
      "<integer name='width' value='32'/><integer name='height' value='32'/></film></sensor>";
  const std::string point =
      "<emitter type='point'><point name='position' value='0.2, 0.1, 1.6'/>"
      "<rgb name='intensity' value='2'/></emitter>";
  const std::string sky = "<emitter type='constant'><rgb name='radiance' value='0.5'/></emitter>";
  const std::string sun =
      "<emitter type='directional'><vector name='direction' value='0.2, 1, -0.4'/>"
      "<rgb name='irradiance' value='2'/></emitter>";
  const std::string bulb = sphere_xml(
      "0.4, -0.3, 1.5", "0.1", "<emitter type='area'><rgb name='radiance' value='9'/></emitter>");
  const std::string lamp = lamp_xml("0.3", "12");
  const auto ball = [](const std::string& where, const std::string& bsdf) {
    return sphere_xml(where, "0.4", bsdf);
  };
  // So many that the choice among them depends on the point.
  std::string many = lamp + bulb + point + sky +
                     "<emitter type='spot'><transform name='to_world'><lookat origin='0.6,0,1.8' "
                     "target='0,0.3,0' up='0,1,0'/></transform></emitter>";
  for (const char* where : {"-0.9, -0.9, 0.3", "0.9, 0.8, 0.1", "-0.8, 0.8, 1.7"})
    many += sphere_xml(where, "0.05",
                       "<emitter type='area'><rgb name='radiance' value='20'/></emitter>");
  return {
      camera + grey_walls + lamp,
      lens + grey_walls + many + ball("-0.4, 0, 0.4", glass) + ball("0.5, 0.2, 0.7", rough_metal),
      camera + room_xml(plastic) + many + ball("0, 0, 0.6", mirror),
      camera + grey_walls + lamp + ball("-0.4, 0, 0.4", glass) + ball("0.5, 0.2, 0.9", mirror),
      lens + grey_walls + bulb + ball("-0.4, 0, 0.5", rough_glass) + ball("0.5, 0, 0.4", plastic),
      camera + room_xml(rough_metal) + lamp + sky + ball("0, 0, 0.6", glass),
      ortho + grey_walls + point + lamp + ball("-0.4, 0, 0.6", holes) +
          ball("0.5, 0, 0.5", rough_metal),
      lens + grey_walls + sun + sky + bulb + ball("0, 0, 0.7", glass),
      camera + room_xml(plastic) + lamp + point + ball("0, 0, 0.7", rough_glass),
      camera + room_xml(plastic) + point + ball("0, 0, 0.5", rough_metal),
      // A path from within glass refracts once more often one way than the other.
      camera + grey_walls + lamp + bulb + sphere_xml("0.4, -0.3, 1.4", "0.35", glass) +
          ball("-0.5, 0.2, 0.5", glass) + sphere_xml("-0.5, 0.1, 0.5", "0.2", grey("0.8")),
  };
}

/// Rooms in which all rough metal and rough glass is nearly specular, and plastic is so in part.
std::vector<std::string> sharp_scenes() {
  const std::string camera = camera_xml("0, -3, 1", "0, 0, 1", 32);
  const auto ball = [](const std::string& where, const std::string& bsdf) {
    return sphere_xml(where, "0.4", bsdf);
  };
  const std::string metal = "<bsdf type='roughconductor'><float name='alpha' value='0.04'/></bsdf>";
  const std::string glass =
      "<bsdf type='roughdielectric'><float name='alpha' value='0.045'/>"
      "<float name='int_ior' value='1.5'/><float name='ext_ior' value='1'/></bsdf>";
  const std::string plastic = "<bsdf type='roughplastic'><float name='alpha' value='0.02'/></bsdf>";
  const std::string bulb = sphere_xml(
      "0.4, -0.3, 1.4", "0.1", "<emitter type='area'><rgb name='radiance' value='9'/></emitter>");
  return {camera + room_xml(grey("0.7, 0.5, 0.3")) + lamp_xml("0.3", "12") +
              ball("-0.4, 0, 0.4", glass) + ball("0.5, 0.2, 0.9", metal),
          camera + room_xml(plastic) + bulb + sphere_xml("0.4, -0.3, 1.4", "0.3", glass) +
              "<emitter type='point'><point name='position' value='-0.2, 0.1, 1.6'/></emitter>" +
              ball("-0.4, 0, 0.5", metal)};
}

/// Rooms with fog, and where it is.
struct FoggyScene {
  std::string content;
  Point3f center;
  float radius;
  std::array<double, 3> extinction{1.5, 0.7, 0.3};
};

std::vector<FoggyScene> foggy_scenes() {
  const std::string fog =
      "<medium type='homogeneous' id='fog'><rgb name='sigma_t' value='1.5, 0.7, 0.3'/>"
      "<rgb name='albedo' value='0.9'/><phase type='hg'><float name='g' value='0.6'/></phase>"
      "</medium>";
  // Densities count the mean of the three channels for each part of a way between surfaces that are
  // passed; of grey fog that is the product.
  const std::string grey_fog =
      "<medium type='homogeneous' id='fog'><rgb name='sigma_t' value='0.7'/>"
      "<rgb name='albedo' value='0.9'/></medium>";
  const std::string null = "<bsdf type='null'/><ref id='fog' name='interior'/>";
  const std::string walls = room_xml(grey("0.7, 0.5, 0.3")), lamp = lamp_xml("0.3", "12");
  const std::string point =
      "<emitter type='point'><point name='position' value='0.2, 0.1, 1.6'/>"
      "<rgb name='intensity' value='2'/></emitter>";
  const std::string mirror = sphere_xml("-0.5, 0.3, 0.4", "0.3", "<bsdf type='conductor'/>");
  const std::string metal = sphere_xml(
      "0.3, 0, 0.9", "0.2", "<bsdf type='roughconductor'><float name='alpha' value='0.3'/></bsdf>");
  return {
      {fog + camera_xml("0, -3, 1", "0, 0, 1", 32) + walls + lamp + point + mirror + metal +
           sphere_xml("0.1, -0.1, 1", "0.85", null),
       Point3f(0.1f, -0.1f, 1), 0.85f},
      {fog + camera_xml("0, -3, 1", "0, 0, 1", 32, "perspective", "<ref id='fog'/>") + walls +
           lamp + mirror + sphere_xml("0, 0, 0", "9", null),
       Point3f(0, 0, 0), 9},
      // Surfaces that light is scattered by or passes straight.
      {grey_fog + camera_xml("0, -3, 1", "0, 0, 1", 32, "perspective", "<ref id='fog'/>") + walls +
           lamp + point + sphere_xml("0, 0, 0", "9", null) +
           sphere_xml("-0.3, 0, 1", "0.5", holes_xml()) +
           sphere_xml("0.4, 0.2, 0.5", "0.3", holes_xml()),
       Point3f(0, 0, 0),
       9,
       {0.7, 0.7, 0.7}},
  };
}

/// How far a straight way leads through a ball.
double way_through(const FoggyScene& fog, const Point3f& from, const Point3f& to) {
  const double l = double(distance(from, to));
  const Vector3f d = normalize(to - from), o = from - fog.center;
  const double b = double(dot(o, d)), c = double(dot(o, o)) - double(fog.radius) * fog.radius;
  if (b * b <= c) return 0;
  const double root = std::sqrt(b * b - c);
  return std::max(0.0, std::min(l, root - b) - std::max(0.0, -root - b));
}

/// The vertices of one sub-path, with how each was left.
template <class Vertex>
struct Recorded {
  std::vector<Vertex> vertices;
  std::vector<bool> specular;

  void add(const Vertex& v) { vertices.push_back(v), specular.push_back(false); }
};

const Medium* medium_of(const PathVertex&) {
  return nullptr;
}
const Medium* medium_of(const MediaVertex& v) {
  return v.in_medium ? v.medium : nullptr;
}

/// eta as a path from the light to the eye sees it, at a surface that is left by a delta lobe: only
/// glass refracts, what passes holes goes straight on.
double eta_towards_eye(const Scene& scene, const Surface& s, const Vector3f& to_light,
                       const Vector3f& to_eye) {
  const float light = dot(s.shading.n, to_light), eye = dot(s.shading.n, to_eye);
  if (light * eye > 0 || scene.materials[s.shape->material]->passes_straight()) return 1;
  return light > 0 ? double(kGlass) : 1 / double(kGlass);
}

/// Compares weights as they are used with the definition. `fog` belongs to MediaVertex.
template <class Vertex>
class Checker {
 public:
  Checker(const Scene& scene, const TechniqueSet& set, const Windows* windows,
          const FoggyScene* fog = nullptr)
      : scene_(scene), set_(set), windows_(windows), fog_(fog) {}

  /// Looks at pixels in which a partly merged method does not merge.
  void do_not_merge() { merging_ = false; }
  /// Says that the scene is one of sharp_scenes().
  void is_sharp_scene() { sharp_ = true, tolerance_ = 0.1; }
  /// Lets light sub-paths enter the scene by a guide.
  void guide(const EmissionGuide& guide) { guide_ = &guide, tolerance_ = 0.2; }

  void run(uint32_t paths, int max_depth) {
    for (uint32_t i = 0; i < paths; ++i) pair(i, max_depth);
  }
  int64_t compared() const { return compared_; }
  /// Weights that differ by more than 1e-4.
  int64_t inexact() const { return inexact_; }
  /// Paths with points in media among those compared.
  int64_t through_media() const { return through_media_; }

 private:
  using Record = Recorded<Vertex>;
  /// A light sub-path up to a vertex that it then passed straight, and the ends of its vertex pdfs
  /// there.
  struct Branch {
    Record record;
    EndPdfs ends;
  };
  double share(int s, int t) const {
    if (windows_) {
      // Of the definition: sub-paths of T and S segments have T + 1 and S + 1 vertices.
      const bool head = t - 1 <= windows_->eye && s - 1 <= windows_->light;
      if (head) return t == 1 ? windows_->light_paths : 1.0;
      return t - 1 > windows_->eye && s < 2 ? windows_->tail : 0.0;
    }
    if (t == 1) return double(set_.light_paths);
    return s < 2 ? 1.0 : set_.connections ? double(set_.connection_share) : 0.0;
  }
  /// Of merges at x_i: none on nearly specular surfaces, nor within the sharp lobe of a plastic.
  double merge_share(const OraclePath& path, int i) const {
    if (!(set_.merges && merging_)) return 0;
    const double all = double(set_.light_paths);
    if (!sharp_) return all;
    const auto at = [&](int k) { return path.surfaces[size_t(k - 1)].position; };
    const Surface& s = path.surfaces[size_t(i - 1)];
    const Vector3f to_light = i == 1 ? path.to_light : normalize(at(i - 1) - s.position),
                   to_eye =
                       i + 1 == path.segments() ? path.to_lens : normalize(at(i + 1) - s.position);
    const Material& material = *scene_.materials[s.shape->material];
    const Bsdf bsdf = material.bind(s, to_eye);
    const ModelKind kind = bsdf.component(0).kind;
    if (kind == ModelKind::rough_conductor || kind == ModelKind::rough_dielectric) return 0;
    const float densest =
        std::max(bsdf.eval(to_light, Transport::radiance).pdf.value,
                 material.bind(s, to_light).eval(to_eye, Transport::importance).pdf.value);
    return kind == ModelKind::rough_plastic && densest > 100 / kPi ? 0 : all;
  }

  /// `on_light` and `on_lens` are the ends of the path.
  void check(OraclePath path, int s, float weight, const Point3f& on_light,
             const Point3f& on_lens) {
    if (fog_) {
      Point3f from = on_light;
      const auto go = [&](const Point3f& to) {
        double t = 0;
        for (const double sigma : fog_->extinction)
          t += std::exp(-sigma * way_through(*fog_, from, to)) / 3;
        path.transmittance.push_back(t);
        from = to;
      };
      for (const Surface& x : path.surfaces) go(x.position);
      go(on_lens);
      for (const Medium* m : path.media)
        if (m) {
          ++through_media_;
          break;
        }
    }
    if (path.segments() == 2) path.gain = light_sample_gain(path, on_light);
    const auto densities = technique_densities(
        scene_, path, [&](int a, int b) { return share(a, b); }, double(set_.merge_area),
        [&](int i) { return merge_share(path, i); });
    double sum = 0;
    for (const double d : densities) sum += d;
    const double expected = densities[size_t(s)] / sum;
    ++compared_;
    const double error = std::abs(double(weight) - expected);
    inexact_ += error > 1e-4;
    // Long chains of grazing vertices add up the rounding of directions.
    // Sharp lobes and guides make more of it.
    CHECK_MESSAGE(error < tolerance_, "s = ", s, " of ", path.segments(), " segments: ", weight,
                  " for ", expected);
  }

  /// The part of a path that an eye sub-path has made: appended from the light's side to the lens'.
  void append_eye(OraclePath& path, const Record& eye, int count, const Ray& camera_ray) const {
    for (int j = count - 1; j >= 0; --j) {
      const Vertex& v = eye.vertices[size_t(j)];
      const bool specular = j != count - 1 && eye.specular[size_t(j)];
      const Vector3f to_light = j == count - 1 ? path.to_light : -eye.vertices[size_t(j + 1)].wo;
      path.surfaces.push_back(v.surface);
      path.media.push_back(medium_of(v));
      path.specular.push_back(specular);
      path.eta.push_back(specular ? eta_towards_eye(scene_, v.surface, to_light, v.wo) : 1.0);
    }
    const Vertex& first = eye.vertices[0];
    path.to_lens = first.wo;
    path.importance = double(
        scene_.camera->importance(camera_ray, distance(first.position(), camera_ray.origin)));
  }

  /// The part that a light sub-path has made; `next` is where its last vertex is left to.
  void append_light(OraclePath& path, const Record& light, int count, const Vector3f& next,
                    const LightStart& start) const {
    const Vertex& first = light.vertices[0];
    path.to_light = first.wo;
    const double pick = direct_probability(scene_, start.index, first.position());
    path.direct = double(start.light->direct_density(start.emission, first.position())) * pick;
    path.choice = pick, path.is_light_near = !is_infinite(start.light->kind());
    path.emission = double(start.density());
    path.light_can_be_hit = !is_delta(start.light->kind());
    for (int j = 0; j < count; ++j) {
      const Vertex& v = light.vertices[size_t(j)];
      const bool specular = j != count - 1 && light.specular[size_t(j)];
      const Vector3f to_eye = j == count - 1 ? next : -light.vertices[size_t(j + 1)].wo;
      path.surfaces.push_back(v.surface);
      path.media.push_back(medium_of(v));
      path.specular.push_back(specular);
      path.eta.push_back(specular ? eta_towards_eye(scene_, v.surface, v.wo, to_eye) : 1.0);
    }
  }

  /// Of paths of two segments, from `on_light`.
  double light_sample_gain(const OraclePath& path, const Point3f& on_light) const {
    if (Vertex::kMedia || (path.light_can_be_hit && !path.is_light_near)) return 1;
    const Surface& s = path.surfaces[0];
    const double trusted = path.light_can_be_hit ? 0.8 * path.choice : path.choice;
    const double others = std::floor(255 * (1 - trusted) + 0.5) / 255;
    const double d2 =
        path.is_light_near && !path.light_can_be_hit
            ? 1.5 * std::exp2(std::floor(std::log2(double(length_squared(on_light - s.position)))))
            : INFINITY;
    const double pixel = 1 / (path.importance * double(std::abs(dot(s.ng, path.to_lens))));
    return (1 + pixel / d2) / std::max(others + pixel / d2, 1e-6);
  }

  /// The probability with which a light sub-path begins at the light.
  double emission_choice(uint32_t light) const {
    return double(guide_ ? guide_->probability(light) : scene_.emission_picker.probability(light));
  }
  double guided(uint32_t light, const Vector3f& from, const Point3f& through) const {
    return guide_ ? double(guide_->factor(light, *scene_.lights[light], from, through)) : 1.0;
  }

  /// s = 1 at the last vertex of the eye sub-path.
  template <class Weights>
  void check_light_sample(const ConnectionContext<Weights>& connections, const Vertex& v,
                          const Record& eye, const Ray& camera_ray, Sampler& sampler) {
    Sampler same = sampler;
    const Connection connection = connect_light(connections, v, sampler);
    const ChosenLight chosen = choose_light(scene_, v.position(), same);
    if (connection.value.is_black()) return;
    const LightSample& sample = *chosen.sample;
    const double pick = direct_probability(scene_, chosen.light, v.position());
    const double none = sample.finite ? double(length_squared(sample.target - v.position())) : 1;
    OraclePath path;
    path.to_light = sample.wi;
    path.light_can_be_hit = !sample.delta;
    path.direct = (sample.delta ? none : double(sample.pdf.value)) * pick;
    path.choice = pick, path.is_light_near = sample.finite;
    path.emission = double(sample.emission) * emission_choice(chosen.light) *
                    guided(chosen.light, sample.wi, v.position());
    append_eye(path, eye, v.depth, camera_ray);
    check(path, 1, connection.weight,
          sample.finite ? sample.target : v.position() + sample.wi * 1e3f, camera_ray.origin);
  }

  /// One light sub-path and one eye sub-path with all their connections.
  void pair(uint32_t index, int max_depth);
  template <class Weights>
  void eye_subpath(Weights weights, const Ray& camera_ray, int max_depth, Sampler& sampler,
                   SubpathPdfs* pdfs, const Record& light, const std::optional<LightStart>& start);

  const Scene& scene_;
  TechniqueSet set_;
  bool merging_ = true, sharp_ = false;
  double tolerance_ = 0.02;
  const Windows* windows_;
  const FoggyScene* fog_;
  const EmissionGuide* guide_ = nullptr;
  RenderCounters counters_;
  RandomStream random_{1};
  SubpathPdfs light_pdfs_;
  std::vector<Branch> branches_;
  int64_t compared_ = 0;
  int64_t inexact_ = 0, through_media_ = 0;
};

template <class Vertex>
template <class Weights>
void Checker<Vertex>::eye_subpath(Weights weights, const Ray& camera_ray, int max_depth,
                                  Sampler& sampler, SubpathPdfs* pdfs, const Record& light,
                                  const std::optional<LightStart>& start) {
  Record eye;
  SubpathOf<Vertex> subpath = [&] {
    if constexpr (Vertex::kMedia)
      return MediaSubpath(scene_, Subpath(), scene_.camera_medium, sampler.next_1d() * 1e9f);
    else
      return Subpath();
  }();
  subpath.ray = camera_ray;
  subpath.from = camera_ray.origin;
  subpath.throughput = Spectrum(1);
  subpath.pdfs = pdfs;
  ConnectionRoulette roulette(0, 0);
  const ConnectionContext<Weights> connections{
      scene_, LightStarts(scene_, guide_), weights, roulette, counters_, false, &random_};
  int depth = 1;
  const auto arrive_at = [&](const Arrival& a) {
    const Partials partials = depth == 1 ? first_eye_partials(scene_, camera_ray, a, set_, subpath)
                                         : arrive(subpath.partials, a.d2 / a.transmittance,
                                                  a.cosine, set_.subpath_connections());
    record_arrival(subpath, a.d2 / a.transmittance, a.cosine);
    return partials;
  };
  /// Connects the vertex with all of the light sub-path; whether the eye sub-path goes on.
  const auto pass = [&](const Vertex& v) {
    eye.add(v);
    if (v.is_smooth()) check_light_sample(connections, v, eye, camera_ray, sampler);
    const auto connect = [&](const Record& from, const Vertex& l) {
      if (!l.is_smooth()) return;
      const Connection connection = connect_ends(connections, l, v);
      if (connection.value.is_black() || share(l.depth + 1, depth + 1) == 0) return;
      OraclePath path;
      const Vector3f next = normalize(v.position() - l.position());
      append_light(path, from, l.depth, next, *start);
      const Vector3f to_light = path.to_light;
      path.to_light = -next;
      append_eye(path, eye, depth, camera_ray);
      path.to_light = to_light;
      check(path, l.depth + 1, connection.weight, start->subpath.ray.origin, camera_ray.origin);
    };
    if (v.is_smooth()) {
      for (const Vertex& l : light.vertices) connect(light, l);
      for (const Branch& b : branches_) {
        if constexpr (std::is_same_v<Weights, WindowWeights>)
          weights.set_light(light_pdfs_, &b.ends);
        connect(b.record, b.record.vertices.back());
      }
      if constexpr (std::is_same_v<Weights, WindowWeights>) weights.set_light(light_pdfs_);
    }
    bool straight = false;
    if (!scatter<Transport::radiance>(v, set_, {1000, false}, sampler, subpath, &straight))
      return false;
    if (Vertex::kMedia && straight) {
      eye.vertices.pop_back(), eye.specular.pop_back();
      return true;
    }
    eye.specular.back() = subpath.from_specular;
    ++depth;
    return true;
  };
  while (depth < max_depth) {
    Hit hit;
    const bool found = scene_.accel->closest_hit(subpath.ray, hit);
    float transmittance = 1;
    if constexpr (Vertex::kMedia) {
      Ray segment = subpath.ray;
      if (found) segment.tmax = hit.t;
      const float t = subpath.cross(segment, sampler.next_1d(), counters_);
      transmittance = subpath.transmittance;
      if (t < INFINITY) {
        const Point3f p = subpath.ray.origin + subpath.ray.direction * t;
        const float extinction = subpath.medium->nominal_extinction(p);
        const Partials partials =
            arrive_at({p, length_squared(p - subpath.from), extinction, transmittance});
        if (!pass(Vertex({*subpath.medium, extinction, p}, -subpath.ray.direction,
                         {subpath.throughput, partials, depth})))
          return;
        continue;
      }
    }
    Surface s;
    float d2 = 0;
    if (found) {
      s = scene_.surface(subpath.ray, hit);
      d2 = Vertex::kMedia ? length_squared(s.position - subpath.from) : hit.t * hit.t;
    }
    if (depth > 1) {  // s = 0
      Connection connection{};
      double direct = 0, emission = 0, choice = 0;
      if (!found && scene_.environment) {
        connection = connect_escape(connections, subpath, transmittance);
        const double pick = emission_choice(scene_.environment_index);
        direct = double(scene_.environment->pdf_direct(subpath.from, subpath.ray.direction).value) *
                 direct_probability(scene_, scene_.environment_index, subpath.from);
        emission = double(scene_.environment->emission_density(subpath.ray.direction) * pick) *
                   guided(scene_.environment_index, subpath.ray.direction, subpath.from);
      } else if (found && scene_.light_on(*s.shape)) {
        connection =
            connect_hit(connections, subpath, s, d2, Vertex::kMedia ? 0 : depth, transmittance);
        const SurfaceLight& l = *scene_.light_on(*s.shape);
        const double pick = emission_choice(s.shape->light);
        choice = direct_probability(scene_, s.shape->light, subpath.from);
        direct = double(l.pdf_direct(subpath.from, s, subpath.ray.direction, d2).value) * choice;
        emission = double(l.emission_density(s, -subpath.ray.direction)) * pick *
                   guided(s.shape->light, subpath.ray.direction, s.position);
      }
      if (!connection.value.is_black()) {
        OraclePath path;
        path.to_light = subpath.ray.direction;
        path.direct = direct, path.emission = emission;
        path.choice = choice, path.is_light_near = found;
        append_eye(path, eye, depth - 1, camera_ray);
        // The last vertex was left by a lobe of its own.
        path.specular[0] = subpath.from_specular;
        if (subpath.from_specular)
          path.eta[0] =
              eta_towards_eye(scene_, path.surfaces[0], path.to_light, eye.vertices.back().wo);
        check(path, 0, connection.weight, s.position, camera_ray.origin);
      }
    }
    if (!found) return;
    const float cosine = std::abs(dot(s.ng, subpath.ray.direction));
    if (!(cosine > 0)) return;
    const Partials partials = arrive_at({s.position, d2, cosine, transmittance});
    if constexpr (Vertex::kMedia) {
      if (!pass(Vertex(scene_, s, -subpath.ray.direction, {subpath.throughput, partials, depth},
                       subpath.medium)))
        return;
    } else if (!pass(Vertex(scene_, s, -subpath.ray.direction, subpath.throughput, partials,
                            depth))) {
      return;
    }
  }
}

template <class Vertex>
void Checker<Vertex>::pair(uint32_t index, int max_depth) {
  Sampler sampler(SampleSequence::independent, 7, 0, index);
  sampler.start_sample(0);
  Record light;
  Sampler light_sampler(SampleSequence::independent, 8, 0, index);
  light_sampler.start_sample(0);
  Sampler same = light_sampler;
  same.start_dimension(0);
  const auto start = start_light_subpath(scene_, LightStarts(scene_, guide_), same);
  const LightStarts starts(scene_, guide_);
  ConnectionRoulette roulette(0, 0);
  branches_.clear();
  EndPdfs ends{};  // at the last vertex
  const auto visit_with = [&](const auto& weights) {
    return [&](const Vertex& v, const Hit&) {
      // What was passed straight is no vertex of what follows.
      if (!light.vertices.empty() && light.vertices.back().depth == v.depth) {
        if (light.vertices.back().is_smooth()) branches_.push_back({light, ends});
        light.vertices.pop_back(), light.specular.pop_back();
      }
      ends = {light_pdfs_.front(), light_pdfs_.back()};
      if (!light.vertices.empty()) {
        // How the one before was left.
        light.specular.back() = light_pdfs_[size_t(v.depth - 1)].specular;
      }
      light.add(v);
      if (!v.is_smooth()) return;
      const auto seen = connect_camera(
          ConnectionContext<std::decay_t<decltype(weights)>>{scene_, starts, weights, roulette,
                                                             counters_, false, &random_},
          v, sampler.next_2d(), false);
      if (!seen || share(v.depth + 1, 1) == 0) return;
      const auto lens = scene_.camera->sample_lens(v.position(), {0.5f, 0.5f});
      if (!lens || scene_.camera->has_lens()) return;
      OraclePath path;
      append_light(path, light, v.depth, lens->direction, *start);
      path.to_lens = lens->direction;
      path.importance = double(lens->importance);
      check(path, v.depth + 1, seen->connection.weight, start->subpath.ray.origin, lens->target);
    };
  };
  const auto trace = [&](const auto& weights) {
    trace_light_subpath<Vertex>({scene_,
                                 starts,
                                 set_,
                                 {1000, false},
                                 max_depth - 1,
                                 light_sampler,
                                 counters_,
                                 &light_pdfs_,
                                 uint64_t(index + 1)},
                                visit_with(weights));
    // The last surface may have been passed on the way out.
    if (!light.vertices.empty() && light_pdfs_.size() == light.vertices.size()) {
      if (light.vertices.back().is_smooth()) branches_.push_back({light, ends});
      light.vertices.pop_back(), light.specular.pop_back();
    }
  };
  const Ray camera_ray = scene_.camera->sample_ray({32 * sampler.next_1d(), 32 * sampler.next_1d()},
                                                   sampler.next_2d());
  if (windows_) {
    trace(WindowWeights(*windows_, &light_pdfs_, nullptr));
    SubpathPdfs eye_pdfs{{1, 0, 1, false}};
    WindowWeights weights(*windows_, nullptr, &eye_pdfs);
    weights.set_light(light_pdfs_);
    eye_subpath(weights, camera_ray, max_depth, sampler, &eye_pdfs, light, start);
  } else {
    const BalanceWeights weights(set_, merging_);
    trace(weights);
    eye_subpath(weights, camera_ray, max_depth, sampler, nullptr, light, start);
  }
}

TechniqueSet all_techniques(float light_paths) {
  TechniqueSet set;
  set.hits = set.light_samples = set.camera_connections = set.connections = true;
  set.light_paths = light_paths;
  return set;
}

}  // namespace

TEST_CASE("weights of BDPT and VCM are the balance heuristic") {
  int64_t compared = 0, inexact = 0;
  for (const std::string& content : scenes()) {
    const TransportScene s(content);
    for (const bool merges : {false, true})
      for (const float connection_share : {0.0f, 1.0f, 0.4f, 6.0f}) {
        TechniqueSet set = all_techniques(500);
        set.connections = connection_share > 0;
        set.merges = merges;
        set.merge_area = merges ? 0.002f : 0.0f;
        if (set.connections) set.connection_share = connection_share;
        Checker<PathVertex> checker(*s.scene, set, nullptr);
        checker.run(1500, 7);
        compared += checker.compared(), inexact += checker.inexact();
      }
  }
  CHECK(compared > 100000);
  CHECK(double(inexact) < 2e-3 * double(compared));
}

TEST_CASE("weights count how a guide lets light sub-paths begin") {
  int64_t compared = 0, inexact = 0;
  int entered = 0, directed = 0;
  for (const std::string& content : scenes()) {
    const TransportScene s(content);
    // Rays most of which enter near one point of the disk, or leave near one direction, and of some
    // lights more than of others.
    std::vector<EmissionGuide::Record> rays;
    for (uint32_t light = 0; light < s.scene->lights.size(); ++light) {
      const bool enters = s.scene->lights[light]->entered_sphere();
      entered += enters;
      directed += s.scene->lights[light]->direction_numbers({0, 0, 1}).has_value();
      for (uint32_t i = 0; i < 4000; ++i) {
        Sampler sampler(SampleSequence::sobol, 3, 0, 0);
        sampler.start_sample(i);
        const auto e = s.scene->lights[light]->sample_emission({0.5f, 0.5f}, sampler.next_2d());
        if (!e) continue;
        const Point2f u = sampler.next_2d();
        rays.push_back({light,
                        -e->ray.direction,
                        {0.2f + 0.6f * u.x * u.x, 0.7f * u.y},
                        float(1 + light % 3)});
      }
    }
    const EmissionGuide guide(s.scene->lights, s.scene->emission_picker, rays);
    for (const bool merges : {false, true}) {
      TechniqueSet set = all_techniques(500);
      set.merges = merges;
      set.merge_area = merges ? 0.002f : 0.0f;
      Checker<PathVertex> checker(*s.scene, set, nullptr);
      checker.guide(guide);
      checker.run(1500, 7);
      compared += checker.compared(), inexact += checker.inexact();
    }
  }
  CHECK(entered >= 4);
  CHECK(directed >= 20);
  CHECK(compared > 40000);
  // As many as without a guide on these scenes, which are the harder ones.
  CHECK(double(inexact) < 4e-3 * double(compared));
}

TEST_CASE("weights are the balance heuristic in pixels with and without merging") {
  int64_t compared = 0, inexact = 0;
  for (const std::string& content : scenes()) {
    const TransportScene s(content);
    for (const bool merging : {false, true})
      for (const bool connections : {false, true}) {
        TechniqueSet set = all_techniques(500);
        set.merges = set.partly_merged = true;
        set.merge_area = 0.002f;
        set.connections = connections;
        if (connections) set.connection_share = 0.4f;
        Checker<PathVertex> checker(*s.scene, set, nullptr);
        if (!merging) checker.do_not_merge();
        checker.run(1500, 7);
        compared += checker.compared(), inexact += checker.inexact();
      }
  }
  CHECK(compared > 50000);
  CHECK(double(inexact) < 2e-3 * double(compared));
}

TEST_CASE("weights count no merges where surfaces are nearly specular") {
  int64_t compared = 0, inexact = 0;
  for (const std::string& content : sharp_scenes()) {
    const TransportScene s(content);
    for (const bool partly : {false, true})
      for (const bool merging : {true, false}) {
        if (!partly && !merging) continue;
        TechniqueSet set = all_techniques(500);
        set.merges = true;
        set.partly_merged = partly;
        set.merge_area = 0.02f;
        Checker<PathVertex> checker(*s.scene, set, nullptr);
        checker.is_sharp_scene();
        if (!merging) checker.do_not_merge();
        checker.run(2000, 7);
        compared += checker.compared(), inexact += checker.inexact();
      }
  }
  CHECK(compared > 20000);
  CHECK(double(inexact) < 0.02 * double(compared));
}

TEST_CASE("weights of path reuse are exact under any limits") {
  const std::vector<Windows> settings{
      {4, 3, 1, 700},   {4, 3, 0.5, 700}, {2, 1, 1, 700}, {2, 5, 1, 700},   {8, 1, 1, 700},
      {8, 0, 0.3, 700}, {1, 2, 0.7, 700}, {0, 7, 1, 700}, {0, 0, 0.9, 700}, {7, 7, 1, 700},
      {3, 3, 1, 700},   {1, 1, 0.2, 700}, {6, 2, 1, 700}, {5, 6, 0.8, 700}};
  int64_t compared = 0, inexact = 0;
  for (const std::string& content : scenes()) {
    const TransportScene s(content);
    for (const Windows& w : settings) {
      Checker<PathVertex> checker(*s.scene, all_techniques(float(w.light_paths)), &w);
      checker.run(600, 7);
      compared += checker.compared(), inexact += checker.inexact();
    }
  }
  CHECK(compared > 100000);
  CHECK(double(inexact) < 2e-3 * double(compared));
}

TEST_CASE("weights in media are the balance heuristic") {
  int64_t compared = 0, inexact = 0, through_media = 0;
  const auto take = [&](const auto& checker) {
    compared += checker.compared(), inexact += checker.inexact();
    through_media += checker.through_media();
  };
  for (const FoggyScene& fog : foggy_scenes()) {
    const TransportScene s(fog.content);
    for (const bool merges : {false, true}) {
      TechniqueSet set = all_techniques(500);
      set.merges = merges;
      set.merge_area = merges ? 0.002f : 0.0f;
      set.connections = !merges || fog.radius < 1;
      set.connection_share = merges && set.connections ? 0.4f : 1.0f;
      Checker<MediaVertex> checker(*s.scene, set, nullptr, &fog);
      checker.run(3000, 7);
      take(checker);
    }
    for (const Windows& w : {Windows{4, 3, 1, 700}, {2, 1, 0.5, 700}, {0, 7, 1, 700}}) {
      Checker<MediaVertex> checker(*s.scene, all_techniques(float(w.light_paths)), &w, &fog);
      checker.run(2000, 7);
      take(checker);
    }
  }
  CHECK(compared > 50000);
  CHECK(through_media > 25000);
  CHECK(double(inexact) < 2e-3 * double(compared));
}
