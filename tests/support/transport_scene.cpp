#include "support/transport_scene.h"
#include "support/source_path.h"

namespace duet::test {

TransportScene::TransportScene(const std::string& content, const std::string& version) {
  ReadResult read = read_text("<scene version='" + version + "'>" + content + "</scene>");
  REQUIRE_MESSAGE(read.scene, read.messages());
  prepare(read.scene->description);
}

TransportScene::TransportScene(SceneDescription description) {
  prepare(description);
}

TransportScene::TransportScene(const TemporaryDirectory& folder, const std::string& content) {
  const std::string file =
      folder.write("scene.xml", "<scene version='3.0.0'>" + content + "</scene>");
  Diagnostics diagnostics;
  auto read = read_mitsuba(file, {}, diagnostics);
  REQUIRE(read);
  prepare(read->description);
}

TransportScene::TransportScene(const std::string& folder, int size) {
  MitsubaOptions options;
  options.defines = {{"size", std::to_string(size)}};
  Diagnostics diagnostics;
  auto read = read_mitsuba(source_path("scenes/") + folder + "/scene.xml", options, diagnostics);
  REQUIRE(read);
  prepare(read->description);
}

TransportScene::TransportScene(TransportScene&&) noexcept = default;
TransportScene::~TransportScene() = default;

void TransportScene::prepare(SceneDescription& d) {
  const FilmDescription& film = d.sensors.at(0).film;
  layout = {{film.width, film.height}, {0, 0, film.width, film.height}, film.filter};
  integrator = d.integrator;
  BuildOptions build;
  build.threads = 2;
  build.layer_needs = integrator_needs(d.integrator);
  Diagnostics diagnostics;
  scene = build_scene(std::move(d), build, diagnostics);
  REQUIRE(scene);
}

std::unique_ptr<Integrator> TransportScene::method(const std::string& name,
                                                   const Parameters& parameters,
                                                   TechniqueOutput techniques) const {
  IntegratorDescription d = integrator;
  apply_override(d, {name, parameters, {}});
  return make_integrator(d, techniques);
}

RenderResult TransportScene::render(Integrator& made, const FilmLayout& film, int spp,
                                    uint64_t seed, int threads) const {
  RenderRequest request;
  request.budget.spp = spp;
  request.seed = seed;
  request.threads = threads;
  return duet::render(*scene, made, film, request);
}

RenderResult TransportScene::render(const std::string& name, const Parameters& parameters, int spp,
                                    uint64_t seed, int threads) const {
  return render(*method(name, parameters), layout, spp, seed, threads);
}

std::string camera_xml(const std::string& origin, const std::string& target, int size,
                       const std::string& type, const std::string& extra) {
  const std::string n = std::to_string(size);
  return "<sensor type='" + type + "'><float name='fov' value='50'/>" + extra +
         "<transform name='to_world'><lookat origin='" + origin + "' target='" + target +
         "' up='0,0,1'/></transform><film type='hdrfilm'><integer name='width' value='" + n +
         "'/><integer name='height' value='" + n + "'/><rfilter type='box'/></film></sensor>";
}

std::string room_xml(const std::string& bsdf) {
  const auto wall = [&](const std::string& transform) {
    return "<shape type='rectangle'><transform name='to_world'>" + transform + "</transform>" +
           bsdf + "</shape>";
  };
  return wall("") + wall("<rotate x='1' angle='180'/><translate z='2'/>") +
         wall("<rotate x='1' angle='90'/><translate y='1' z='1'/>") +
         wall("<rotate y='1' angle='90'/><translate x='-1' z='1'/>") +
         wall("<rotate y='1' angle='-90'/><translate x='1' z='1'/>");
}

std::string grey(const std::string& reflectance) {
  return "<bsdf type='twosided'><bsdf type='diffuse'><rgb name='reflectance' value='" +
         reflectance + "'/></bsdf></bsdf>";
}

std::string sphere_xml(const std::string& center, const std::string& radius,
                       const std::string& content) {
  return "<shape type='sphere'><point name='center' value='" + center +
         "'/><float name='radius' value='" + radius + "'/>" + content + "</shape>";
}

std::string lamp_xml(const std::string& size, const std::string& radiance) {
  return "<shape type='rectangle'><transform name='to_world'><scale value='" + size +
         "'/><rotate x='1' angle='180'/><translate z='1.95'/></transform><emitter type='area'>"
         "<rgb name='radiance' value='" +
         radiance + "'/></emitter></shape>";
}

}  // namespace duet::test
