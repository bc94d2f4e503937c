// Renders the project's scenes within a test.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "integrators/make_integrator.h"
#include "integrators/pass.h"
#include "mitsuba/mitsuba.h"
#include "scene/build.h"

namespace duet::test {

using Defines = std::vector<std::pair<std::string, std::string>>;

inline std::string source_path(const std::string& path) {
  return std::string(DUET_SOURCE_DIR) + "/" + path;
}

/// A scene of the folder scenes/, ready to be rendered.
class PreparedScene {
 public:
  /// `method` and its parameters replace the scene's integrator if a name is given.
  explicit PreparedScene(const std::string& name, const Defines& defines = {},
                         const IntegratorOverride& method = {}) {
    Diagnostics diagnostics;
    MitsubaOptions options;
    options.defines = defines;
    auto read = read_mitsuba(source_path("scenes/" + name + "/scene.xml"), options, diagnostics);
    REQUIRE(read);
    SceneDescription& d = read->description;
    const FilmDescription& film = d.sensors.at(0).film;
    layout = {{film.width, film.height}, {0, 0, film.width, film.height}, film.filter};
    layout.ends_at_crop = film.crop.has_value();
    if (film.crop)
      layout.crop = {film.crop->x, film.crop->y, film.crop->x + film.crop->width,
                     film.crop->y + film.crop->height};
    apply_override(d.integrator, method);
    integrator = make_integrator(d.integrator);
    BuildOptions build;
    build.threads = 2;
    build.layer_needs = integrator_needs(d.integrator);
    scene = build_scene(std::move(d), build, diagnostics);
    REQUIRE(scene);
  }

  Image render(int spp, int threads = 2) const { return render(spp, threads, layout.crop); }
  Image render(int spp, int threads, const PixelBounds& crop, uint64_t seed = 0) const {
    FilmLayout part = layout;
    part.crop = crop;
    RenderRequest request;
    request.budget.spp = spp;
    request.seed = seed;
    request.threads = threads;
    return duet::render(*scene, *integrator, part, request).image;
  }

  FilmLayout layout;
  std::unique_ptr<Integrator> integrator;
  std::unique_ptr<Scene> scene;
};

}  // namespace duet::test
