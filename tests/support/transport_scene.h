// Small scenes for tests of light transport, from texts.
#pragma once

#include <doctest/doctest.h>

#include "integrators/make_integrator.h"
#include "integrators/pass.h"
#include "scene/build.h"
#include "support/files.h"
#include "support/memory_scene.h"

namespace duet::test {

struct TransportScene {
  FilmLayout layout;
  std::unique_ptr<Scene> scene;
  IntegratorDescription integrator;

  /// `content` is what stands within the <scene> of a file.
  explicit TransportScene(const std::string& content, const std::string& version = "3.0.0");
  explicit TransportScene(SceneDescription description);
  /// The same as a file on the disk, which finds others there.
  TransportScene(const TemporaryDirectory& folder, const std::string& content);
  /// A scene of the folder scenes/ in a size of its own.
  TransportScene(const std::string& folder, int size);
  TransportScene(TransportScene&&) noexcept;
  ~TransportScene();

  using Parameters = std::vector<std::pair<std::string, std::string>>;
  std::unique_ptr<Integrator> method(const std::string& name, const Parameters& parameters,
                                     TechniqueOutput techniques = TechniqueOutput::none) const;
  RenderResult render(Integrator& made, const FilmLayout& film, int spp, uint64_t seed,
                      int threads = 2) const;
  RenderResult render(const std::string& name, const Parameters& parameters, int spp, uint64_t seed,
                      int threads = 2) const;

 private:
  void prepare(SceneDescription& d);
};

/// A camera at `origin` that looks at `target`, z up, with a square image.
std::string camera_xml(const std::string& origin, const std::string& target, int size,
                       const std::string& type = "perspective", const std::string& extra = "");

/// A box from (-1, -1, 0) to (1, 1, 2), open towards -y, of the given BSDF.
std::string room_xml(const std::string& bsdf);

std::string grey(const std::string& reflectance);

std::string sphere_xml(const std::string& center, const std::string& radius,
                       const std::string& content);

/// A rectangle under the ceiling of the room, facing down.
std::string lamp_xml(const std::string& size, const std::string& radiance);

}  // namespace duet::test
