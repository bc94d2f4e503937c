// Renders the project's scenes within a test.
#pragma once

#include <doctest/doctest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "evaluate/report/read_scene.h"
#include "integrators/make_integrator.h"
#include "integrators/pass.h"
#include "scene/build.h"
#include "scene/film_layout.h"
#include "support/source_path.h"

namespace duet::test {

using Defines = std::vector<std::pair<std::string, std::string>>;

/// A scene of the folder scenes/, ready to be rendered.
class PreparedScene {
 public:
  /// `method` and its parameters replace the scene's integrator if a name is given; `change` alters
  /// what the file describes.
  explicit PreparedScene(const std::string& name, const Defines& defines = {},
                         const IntegratorOverride& method = {},
                         const std::function<void(SceneDescription&)>& change = {}) {
    Diagnostics diagnostics;
    ReadingOptions options;
    options.defines = defines;
    const std::string file = source_path("scenes/" + name + "/scene.");
    auto read = read_scene(file + (std::filesystem::exists(file + "pbrt") ? "pbrt" : "xml"),
                           options, diagnostics);
    REQUIRE(read);
    SceneDescription& d = read->description;
    if (change) change(d);
    layout = film_layout(d.sensors.at(0).film);
    apply_override(d.integrator, method);
    Diagnostics limits;
    check_support(d, d.integrator, limits);
    check_support(d.sensors.at(0), d.integrator, limits);
    is_supported = !limits.has_errors();
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
  bool is_supported = true;  ///< the method can render the scene
  std::unique_ptr<Integrator> integrator;
  std::unique_ptr<Scene> scene;
};

}  // namespace duet::test
