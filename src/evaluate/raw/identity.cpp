#include "evaluate/raw/identity.h"

#include <stdexcept>

#include "integrators/auto.h"
#include "scene/content_hash.h"

namespace duet {

std::string scene_identity(const SceneDescription& scene, size_t sensor) {
  SceneDescription seen = scene;
  seen.sensors = {scene.sensors[sensor]};
  seen.sensors[0].sampler = {};
  seen.integrator = {};
  return content_hash(seen).text();
}

RawImage raw_image(const RenderRecord& record, const Integrator& integrator,
                   const FilmLayout& layout) {
  RawImage image;
  image.integrator = record.integrator, image.parameters = record.integrator_parameters;
  image.decision = record.decision;
  image.sampler = record.sampler, image.seed = record.seed;
  image.target_error = record.requested.target_error;
  image.noise_only = record.noise_only;
  image.layout = layout;
  // What a film gathers does not depend on its size.
  Film pixel({{1, 1}, {0, 0, 1, 1}, layout.filter}, integrator.channels());
  integrator.prepare(pixel);
  image.contents = pixel.contents();
  return image;
}

void adopt_decision(const RawFilm& film, const std::string& scene, const RenderRecord& record,
                    Integrator& integrator) {
  const RawImage& image = film.image();
  if (image.scene_hash != scene || image.integrator != record.integrator ||
      image.parameters != record.integrator_parameters)
    return;
  auto* chooser = dynamic_cast<AutoIntegrator*>(&integrator);
  const auto& decision = image.decision;
  if (!chooser || !decision) return;
  try {
    chooser->adopt(*decision);
  } catch (const std::invalid_argument& e) {
    throw ReadError(fmt::format("{}: {}", film.path(), e.what()));
  }
}

}  // namespace duet
