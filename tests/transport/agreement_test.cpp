// Methods that are unbiased have one mean, whatever they do; those that merge come near it.
#include "base/parallel.h"
#include "image/tile_test.h"
#include "support/show.h"
#include "support/statistics.h"
#include "support/transport_scene.h"
#include "support/volume_files.h"

using namespace duet;
using namespace duet::test;

namespace {

constexpr int kBatches = 16;

struct Case {
  std::string name;
  std::function<TransportScene(int size)> make;
  bool light_tracing = false;  ///< sees everything: no specular surface in view
  int effort = 1;              ///< times as many samples, where some are rare and bright
  bool in_short = false;       ///< part of the short version
  bool has_media = false;      ///< `volpath` instead of `path`
  /// Whether light samples alone have finite variance: not where light is scattered next to a point
  /// that shines. Nor has light tracing next to the camera.
  bool bounded = true;
  TransportScene::Parameters parameters{};  ///< of all methods
};

std::string material(const std::string& type, const std::string& content = "") {
  return "<bsdf type='" + type + "'>" + content + "</bsdf>";
}

/// Glass of the given indices.
std::string glass(const std::string& inside, const std::string& outside,
                  const std::string& type = "dielectric", const std::string& extra = "") {
  return material(type, "<float name='int_ior' value='" + inside +
                            "'/><float name='ext_ior' value='" + outside + "'/>" + extra);
}

/// An octahedron whose normals are those of a ball, and a screen: few connections pass them.
std::string obstacles(const TemporaryDirectory& folder) {
  const char* const text =
      "v 1 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n"
      "vn 1 0 0\nvn 0 1 0\nvn -1 0 0\nvn 0 -1 0\nvn 0 0 1\nvn 0 0 -1\n"
      "f 1//1 2//2 5//5\nf 2//2 3//3 5//5\nf 3//3 4//4 5//5\nf 4//4 1//1 5//5\n"
      "f 2//2 1//1 6//6\nf 3//3 2//2 6//6\nf 4//4 3//3 6//6\nf 1//1 4//4 6//6\n";
  const std::string file = folder.write("octahedron.obj", text);
  return "<shape type='obj'><string name='filename' value='" + file +
         "'/><transform name='to_world'><scale value='0.6'/><translate x='-0.3' z='0.7'/>"
         "</transform>" +
         grey("0.6, 0.7, 0.5") +
         "</shape><shape type='rectangle'><transform name='to_world'><scale value='0.7'/>"
         "<rotate y='1' angle='90'/><translate x='0.4' z='0.8'/></transform>" +
         material("twosided", grey("0.5")) + "</shape>";
}

/// A floor whose normals lean away from the camera: light reaches what is seen of it from between
/// the horizons of both normals.
std::string leaning(const TemporaryDirectory& folder) {
  const std::string file = folder.write("leaning.obj",
                                        "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n"
                                        "vn 0 0.985 0.17\nf 1//1 2//1 3//1\nf 1//1 3//1 4//1\n");
  return "<shape type='obj'><string name='filename' value='" + file +
         "'/><transform name='to_world'><translate z='0.05'/></transform>" +
         material("twosided", grey("0.9, 0.8, 0.7")) + "</shape>";
}

/// Some of them with files in `folder`.
std::vector<Case> cases(const TemporaryDirectory& folder) {
  const auto text = [&folder](const std::string& content) {
    return [content, &folder](int size) {
      return TransportScene(folder, camera_xml("0, -3, 1", "0, 0, 1", size) + content);
    };
  };
  const auto lens = [](const std::string& content) {
    return [content](int size) {
      return TransportScene(camera_xml("0.2, -3, 1.2", "0, 0, 1", size, "thinlens",
                                       "<float name='aperture_radius' value='0.15'/>"
                                       "<float name='focus_distance' value='3'/>") +
                            content);
    };
  };
  const std::string room = room_xml(grey("0.7, 0.6, 0.5")), lamp = lamp_xml("0.4", "8");
  const std::string area = "<emitter type='area'><rgb name='radiance' value='";
  const std::string unequal =
      lamp_xml("0.05", "90") + sphere_xml("-0.6, 0.3, 0.6", "0.15", area + "1, 2, 3'/></emitter>") +
      sphere_xml("0.7, -0.2, 0.3", "0.08", area + "6, 2, 1'/></emitter>") +
      "<emitter type='constant'><rgb name='radiance' value='0.4'/></emitter>";
  const std::string point =
      "<emitter type='point'><point name='position' value='0.3, -0.2, 1.2'/>"
      "<rgb name='intensity' value='1.5'/></emitter>"
      "<emitter type='spot'><transform name='to_world'><lookat origin='-0.5,-0.5,1.8' "
      "target='-0.3,0.4,0' up='1,0,0'/></transform><rgb name='intensity' value='4'/></emitter>"
      "<emitter type='directional'><vector name='direction' value='0.3, 1, -0.5'/>"
      "<rgb name='irradiance' value='0.7'/></emitter>";
  const std::string bumps =
      material("bumpmap",
               "<texture type='checkerboard' name='arbitrary'><float name='color0' "
               "value='0.2'/><float name='color1' value='0.8'/></texture>"
               "<float name='scale' value='0.3'/>" +
                   material("roughconductor", "<float name='alpha' value='0.3'/>"));
  const std::string tilted =
      material("normalmap",
               "<texture type='checkerboard' name='normalmap'><rgb name='color0' value='0.75, 0.5, "
               "0.933'/><rgb name='color1' value='0.25, 0.5, 0.933'/></texture>" +
                   grey("0.7, 0.6, 0.5"));
  const std::string checker =
      "<texture type='checkerboard' name='radiance'><rgb name='color0' value='0.9, 0.6, 0.3'/>"
      "<rgb name='color1' value='0.05'/><transform name='to_uv'><scale value='3'/></transform>"
      "</texture>";
  const std::string group =
      "<shape type='shapegroup' id='things'><shape type='cube'><transform name='to_world'>"
      "<scale value='0.2'/></transform>" +
      grey("0.3, 0.5, 0.8") +
      "</shape><shape type='sphere'>"
      "<point name='center' value='0, 0, 0.4'/><float name='radius' value='0.2'/>" +
      material("roughplastic", "<float name='alpha' value='0.2'/>") + "</shape></shape>";
  const auto instance = [](const std::string& transform) {
    return "<shape type='instance'><ref id='things'/><transform name='to_world'>" + transform +
           "</transform></shape>";
  };
  return {
      {"the thesis's empty box", [](int n) { return TransportScene("thesis-empty", n); }, true, 1,
       true},
      {"the thesis's modified box", [](int n) { return TransportScene("thesis-modified", n); },
       false, 8},
      {"three unequal lights and a sky", text(room + unequal), true, 1, true},
      {"point, spot and parallel light", text(room + point), true},
      {"glass in glass",
       text(room + lamp + sphere_xml("0, 0, 0.8", "0.7", glass("1.33", "1")) +
            sphere_xml("0, 0, 0.8", "0.4", glass("1.5", "1.33"))),
       false, 8},
      {"rough glass and plastic",
       text(room + lamp +
            sphere_xml("-0.4, 0, 0.6", "0.4",
                       glass("1.5", "1", "roughdielectric", "<float name='alpha' value='0.25'/>")) +
            sphere_xml("0.5, 0, 0.5", "0.35", material("plastic")))},
      {"coats and layers",
       text(room_xml(material("twosided", material("coateddiffuse",
                                                   "<float name='alpha_u' value='0.3'/>"
                                                   "<float name='alpha_v' value='0.3'/>"))) +
            lamp +
            sphere_xml("-0.4, 0, 0.6", "0.4",
                       material("coatedconductor",
                                "<float name='alpha_u' value='0.3'/>"
                                "<float name='conductor_alpha_u' value='0.4'/>"
                                "<rgb name='reflectance' value='0.9, 0.7, 0.4'/>"
                                "<float name='thickness' value='0.4'/>"
                                "<rgb name='albedo' value='0.8'/>")) +
            sphere_xml("0.5, 0, 0.5", "0.35",
                       material("coateddiffuse",
                                "<float name='thickness' value='0.5'/>"
                                "<rgb name='albedo' value='0.9'/>"))),
       // What layers return is random itself, so that with roulette some tiles have rare bright
       // paths.
       false,
       2,
       true,
       false,
       true,
       {{"rr_depth", "5"}}},
      {"smooth normals", [](int n) { return TransportScene("mesh-lumpy", n); }},
      {"tilted normals", text(room_xml(material("twosided", tilted)) + lamp), true},
      {"normals of a ball on few triangles", text(room + lamp + obstacles(folder)), true, 1, true},
      {"strict normals and a lamp in view that is hidden",
       text(room + lamp + leaning(folder) + unequal +
            sphere_xml("0.2, -1.6, 0.9", "0.15", area + "3, 4, 5'/></emitter>")),
       false,
       2,
       true,
       false,
       true,
       {{"strict_normals", "true"}, {"hide_emitters", "true"}}},
      {"bumps", text(room_xml(material("twosided", bumps)) + lamp), true, 1, true},
      {"a textured lamp",
       text(room +
            "<shape type='rectangle'><transform name='to_world'><scale value='0.5'/>"
            "<rotate x='1' angle='180'/><translate z='1.9'/></transform>"
            "<emitter type='area'>" +
            checker + "</emitter></shape>"),
       true},
      {"instances",
       text(room + lamp + group + instance("<translate x='-0.4' z='0.3'/>") +
            instance("<scale x='-1.3' y='0.8'/><rotate z='1' angle='30'/>"
                     "<translate x='0.5' z='0.6'/>")),
       true},
      {"a thin lens",
       lens(room + lamp + sphere_xml("0.3, -0.5, 0.5", "0.3", grey("0.2, 0.6, 0.3"))), true, 1,
       true},
      {"holes",
       text(room + lamp +
            sphere_xml("0, 0, 0.9", "0.5",
                       material("mask",
                                "<float name='opacity' "
                                "value='0.6'/>" +
                                    grey("0.6")))),
       false, 8},
  };
}

/// Rooms with media, some of them given by a grid in `folder`.
std::vector<Case> cases_with_media(const TemporaryDirectory& folder) {
  const std::string room = room_xml(grey("0.7, 0.6, 0.5")), lamp = lamp_xml("0.4", "8");
  const auto homogeneous = [](const std::string& id, const std::string& sigma_t,
                              const std::string& albedo, const std::string& g) {
    return "<medium type='homogeneous' id='" + id + "'><rgb name='sigma_t' value='" + sigma_t +
           "'/><rgb name='albedo' value='" + albedo +
           "'/><phase type='hg'><float name='g' value='" + g + "'/></phase></medium>";
  };
  std::vector<float> values;
  for (int i = 0; i < 5 * 4 * 3; ++i)
    for (int c = 0; c < 3; ++c) values.push_back(float((i * 7 + c * 3) % 11) * 0.6f);
  const std::string file = folder.write("cloud.vol", float_volume(5, 4, 3, 3, values));
  const std::string grid =
      "<medium type='heterogeneous' id='cloud'><volume name='sigma_t' type='gridvolume'><string "
      "name='filename' value='" +
      file +
      "'/><transform name='to_world'><translate x='-0.5' y='-0.5' z='0.1'/><scale x='1.2' y='1' "
      "z='1.4'/></transform></volume><rgb name='albedo' value='0.9, 0.8, 0.95'/></medium>";
  const auto inside = [](const std::string& id, const std::string& bsdf = "<bsdf type='null'/>") {
    return bsdf + "<ref id='" + id + "' name='interior'/>";
  };
  const std::string box =  // holds room and camera
      "<shape type='cube'><transform name='to_world'><scale value='5'/></transform>";
  const std::string fog = homogeneous("fog", "0.2, 0.3, 0.5", "0.9, 0.8, 0.7", "0.5");
  const std::string wax = homogeneous("wax", "6, 3, 1.5", "0.95, 0.9, 0.6", "-0.4");
  const std::string near = "<float name='near_clip' value='0.01'/>";
  const std::string area = "<emitter type='area'><rgb name='radiance' value='";
  const std::string point =
      "<emitter type='point'><point name='position' value='0.4, -0.3, 1.3'/>"
      "<rgb name='intensity' value='1.5, 1, 2'/></emitter>";
  const std::string sky =
      "<emitter type='constant'><rgb name='radiance' value='0.4, 0.5, 0.6'/></emitter>";
  const std::string sun =
      "<emitter type='directional'><vector name='direction' value='0.3, 1, -0.5'/>"
      "<rgb name='irradiance' value='1.5'/></emitter>";
  const auto text = [near, &folder](const std::string& content, const std::string& sensor = "") {
    return [=, &folder](int size) {
      return TransportScene(
          folder, camera_xml("0, -3, 1", "0, 0, 1", size, "perspective", near + sensor) + content);
    };
  };
  return {
      {"fog with a camera and lamps in it",
       text(fog + room + lamp + sphere_xml("0.4, 0, 0.4", "0.3", area + "2, 1, 3'/></emitter>") +
                box + inside("fog") + "</shape>",
            "<ref id='fog'/>"),
       false, 2, true, true},
      {"a point that shines in fog",
       text(fog + room + point + sphere_xml("0.2, 0, 1", "0.9", inside("fog"))), true, 2, true,
       true, false},
      {"a cloud under a sky",
       text(grid + room + sky + sun + sphere_xml("0, 0, 0.9", "0.8", inside("cloud")) +
            sphere_xml("0.6, -0.6, 0.2", "0.15", area + "4, 3, 2'/></emitter>")),
       true, 2, true, true},
      {"media in one another, with a lamp in the inner one",
       text(fog + wax + room + lamp + sphere_xml("0, 0, 0.9", "0.8", inside("fog")) +
            sphere_xml("0, 0, 0.9", "0.4", inside("wax") + "<ref id='fog' name='exterior'/>") +
            sphere_xml("0, 0, 0.9", "0.1", area + "30, 20, 20'/></emitter>")),
       true, 2, false, true},
      {"a lamp that is the boundary of a medium",
       text(wax + room + sphere_xml("0, 0, 1", "0.5", inside("wax")) +
            sphere_xml("-0.3, -0.7, 0.5", "0.2",
                       inside("wax", grey("0.5")) + area + "6, 5, 4'/></emitter>")),
       true, 2, false, true},
      {"lamps that reach through the boundaries of media",
       text(fog + wax + room + sphere_xml("0, 0, 0.9", "0.8", inside("fog")) +
            sphere_xml("0, 0, 0.9", "0.4", inside("wax") + "<ref id='fog' name='exterior'/>") +
            sphere_xml("0.2, -0.3, 0.9", "0.25", area + "6, 5, 8'/></emitter>") +
            sphere_xml("-0.75, 0, 0.9", "0.2", area + "8, 6, 5'/></emitter>")),
       true, 2, true, true},
      {"a lamp that touches the boundary of a medium in a camera's medium",
       text(fog + wax + room +
                sphere_xml("0, 0, 0.7", "0.5", inside("wax") + "<ref id='fog' name='exterior'/>") +
                sphere_xml("0, -0.701, 0.7", "0.2", area + "4, 5, 6'/></emitter>") + box +
                inside("fog") + "</shape>",
            "<ref id='fog'/>"),
       false, 2, false, true},
      {"lamps above, in and across a medium that walls close",
       text(wax + room + lamp + "<shape type='rectangle'><transform name='to_world'>" +
            "<translate z='0.6'/></transform>" + inside("wax") + "</shape>" +
            "<shape type='rectangle'><transform name='to_world'><scale y='0.3'/>" +
            "<rotate x='1' angle='90'/><translate y='-1' z='0.3'/></transform>" + inside("wax") +
            "</shape>" + sphere_xml("0.3, 0, 0.6", "0.2", area + "4, 5, 6'/></emitter>") +
            sphere_xml("-0.5, 0.3, 0.25", "0.15", area + "9, 8, 6'/></emitter>")),
       true, 2, false, true},
      {"wax in glass, rough and smooth",
       text(wax + fog + room + lamp +
            sphere_xml("-0.45, 0, 0.6", "0.4",
                       inside("wax", glass("1.5", "1", "roughdielectric",
                                           "<float name='alpha' value='0.25'/>"))) +
            sphere_xml("0.45, 0, 0.6", "0.4", inside("fog", glass("1.3", "1")))),
       false, 8, false, true},
      {"holes and panes in fog",
       text(fog + room + lamp +
                sphere_xml("0, 0, 0.9", "0.5",
                           material("mask", "<float name='opacity' value='0.6'/>" + grey("0.6"))) +
                box + inside("fog") + "</shape>",
            "<ref id='fog'/>"),
       false, 2, true, true},
  };
}

struct Method {
  std::string name;
  TransportScene::Parameters parameters;
};

/// The first one is only for scenes without media, the second only for those with media.
const std::vector<Method>& unbiased() {
  static const std::vector<Method> methods{
      {"path", {}},
      {"volpath", {}},
      {"bdpt", {}},
      {"bdpt", {{"connections", "2"}, {"light_paths", "0.7"}}},
      {"bdpt", {{"light_paths", "1"}}},
      {"reuse", {{"max_eye_depth", "2"}, {"max_light_depth", "1"}}},
      {"reuse",
       {{"max_eye_depth", "1"}, {"max_light_depth", "2"}, {"continue_probability", "0.6"}}},
      {"ptracer", {}},
  };
  return methods;
}

TileBatches render(const TransportScene& scene, const Method& method, int max_depth, int spp,
                   uint64_t seed = 0, const TransportScene::Parameters& more = {}) {
  TransportScene::Parameters p = method.parameters;
  p.insert(p.end(), more.begin(), more.end());
  p.emplace_back("max_depth", std::to_string(max_depth));
  std::vector<Image> images(kBatches);
  parallel_for(kBatches, HardwareThreads().count(), [&](size_t b) {
    images[b] = scene.render(method.name, p, spp, seed * kBatches + b, 1).image;
  });
  TileBatches batches;
  for (const Image& image : images) batches.add(image);
  return batches;
}

/// Compares all pairs of methods that see everything; the levels are those of the whole run.
void check_agreement(const std::vector<Case>& all, const std::vector<int>& depths, int size,
                     int spp) {
  const int pairs = int((unbiased().size() - 1) * (unbiased().size() - 2) / 2);
  const double level = sidak(0.01, int(all.size() * depths.size()) * pairs * 64);
  for (const Case& c : all) {
    const TransportScene scene = c.make(size);
    for (const int depth : depths) {
      std::vector<TileBatches> images;
      std::vector<std::string> names;
      for (const Method& m : unbiased()) {
        if (m.name == (c.has_media ? "path" : "volpath")) continue;
        if (!c.bounded && (m.name == "volpath" || m.name == "reuse")) continue;
        if (m.name == "ptracer" && !c.light_tracing) continue;
        images.push_back(render(scene, m, depth, c.effort * spp, images.size(), c.parameters));
        names.push_back(m.name);
      }
      double total = 0;
      for (size_t i = 0; i < images.size(); ++i)
        for (size_t j = 0; j < i; ++j) {
          const TileComparison r = compare_tiles(images[i], images[j]);
          CAPTURE(c.name);
          CAPTURE(depth);
          CAPTURE(names[i]);
          CAPTURE(names[j]);
          CAPTURE(r.ratio);
          // Of one pair this varies by a quarter.
          CHECK(r.mean_z2 < 2.2);
          CHECK(r.least_p > level);
          total += r.mean_z2;
        }
      CHECK(2 * total / double(images.size() * (images.size() - 1)) < 1.6);
    }
  }
}

}  // namespace

TEST_CASE("unbiased methods have the same mean") {
  const TemporaryDirectory folder;
  std::vector<Case> some = cases(folder);
  std::erase_if(some, [](const Case& c) { return !c.in_short; });
  CHECK(some.size() == 7);
  check_agreement(some, {4}, 16, 16);
}

TEST_CASE("unbiased methods have the same mean in media") {
  const TemporaryDirectory folder;
  std::vector<Case> some = cases_with_media(folder);
  std::erase_if(some, [](const Case& c) { return !c.in_short; });
  CHECK(some.size() == 5);
  check_agreement(some, {3}, 16, 16);
}

TEST_CASE("merging hardly changes the mean of the image") {
  const TransportScene scene(camera_xml("0, -3, 1", "0, 0, 1", 16) + room_xml(grey("0.7")) +
                             lamp_xml("0.4", "8"));
  const double exact = render(scene, {"bdpt", {}}, 4, 16).total().mean();
  for (const char* name : {"ppm", "bpm", "vcm"}) {
    const Method method{name, {{"radius", "0.05"}, {"light_paths", "8"}}};
    CHECK(render(scene, method, 4, 4, 1).total().mean() == doctest::Approx(exact).epsilon(0.02));
  }
}

namespace {

/// Path reuse in the thesis's modified box with sub-paths of at most `eye` and 3 segments.
TileBatches render_reuse(const TransportScene& scene, const std::string& eye, int spp,
                         const TransportScene::Parameters& more) {
  TransportScene::Parameters p{{"max_eye_depth", eye}, {"max_light_depth", "3"}};
  p.insert(p.end(), more.begin(), more.end());
  return render(scene, {"reuse", p}, 8, spp);
}

}  // namespace

TEST_CASE("the test sees the bias of limits and of the thesis's weights") {
  const TransportScene scene("thesis-modified", 32);
  const TileBatches exact = render_reuse(scene, "4", 32, {});
  // No eye sub-path comes to the end of eight segments: what is left are weights that count
  // techniques beyond the light sub-paths' limit.
  const std::pair<const char*, TileBatches> biased[] = {
      {"limits without a tail", render_reuse(scene, "4", 32, {{"continue_probability", "1e-60"}})},
      {"stock weights under limits", render_reuse(scene, "8", 32, {{"weights", "thesis"}})},
      {"reading a",
       render_reuse(scene, "4", 32, {{"weights", "thesis"}, {"thesis_reading", "a"}})}};
  for (const auto& [name, images] : biased) {
    SHOW(std::string(name));
    const TileComparison r = compare_tiles(images, exact);
    CHECK(r.least_p < sidak(0.01, 64));
    CHECK(r.ratio < 0.98);
  }
}

TEST_SUITE("agreement") {
  TEST_CASE("the test sees the bias of the thesis's weights in reading b") {
    // What it counts twice makes up for what it misses: it takes many samples.
    const TransportScene scene("thesis-modified", 64);
    const TileComparison r = compare_tiles(
        render_reuse(scene, "4", 160, {{"weights", "thesis"}, {"thesis_reading", "b"}}),
        render_reuse(scene, "4", 160, {}));
    CHECK(r.least_p < sidak(0.01, 64));
  }

  TEST_CASE("unbiased methods have the same mean at all depths") {
    const TemporaryDirectory folder;
    check_agreement(cases(folder), {2, 3, 4, 5, 6, 7, 8}, 32, 16);
  }

  TEST_CASE("unbiased methods have the same mean in media at all depths") {
    const TemporaryDirectory folder;
    check_agreement(cases_with_media(folder), {2, 3, 6}, 16, 16);
  }

  TEST_CASE("merging comes near the mean, the nearer the smaller the radius") {
    const TransportScene scene(camera_xml("0, -3, 1", "0, 0, 1", 16) + room_xml(grey("0.7")) +
                               lamp_xml("0.4", "8") + sphere_xml("0, 0, 0.7", "0.4", grey("0.5")));
    const TileBatches exact = render(scene, {"bdpt", {}}, 5, 256);
    for (const char* name : {"ppm", "bpm", "vcm"}) {
      CAPTURE(std::string(name));
      double bias2[2];  // mean square over tiles, without what noise adds to it
      int i = 0;
      for (const char* radius : {"0.2", "0.05"}) {
        const TileBatches merged = render(
            scene, {name, {{"radius", radius}, {"alpha", "1"}, {"light_paths", "100"}}}, 5, 16, 1);
        double sum = 0;
        for (int t = 0; t < 64; ++t) {
          const double d = merged.tile(t).mean() - exact.tile(t).mean();
          const double error = std::hypot(merged.tile(t).error(), exact.tile(t).error());
          sum += d * d - error * error;
        }
        bias2[i++] = sum / 64 / (exact.total().mean() * exact.total().mean());
      }
      CAPTURE(bias2[0]);
      CAPTURE(bias2[1]);
      CHECK(bias2[0] > 4 * bias2[1]);
      CHECK(bias2[1] < 0.01 * 0.01);
    }
  }
}
