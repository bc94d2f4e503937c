// Renders the series of images that the checks of the stability table look at.
#pragma once

#include <functional>
#include <memory>

#include "app/stability/catalogue.h"
#include "integrators/integrator.h"

namespace duet::stability {

/// Everything that the pixels of a series depend on.
struct SeriesPlan {
  std::string scene;
  Settings defines, parameters;
  std::string method;
  int spp = 1, batches = 1;
  bool independent = false;
  uint64_t seed = 0;
  /// Tells plans apart.
  std::string key() const;
  uint64_t batch_seed(int batch) const;
};

/// Independent images of one scene by one method; each pixel is the mean of its three colours.
struct Series {
  int width = 0, height = 0;
  std::vector<std::vector<float>> images;
  RenderCounters counters;
  long bad_pixels = 0;  ///< not finite or negative
  size_t pixels() const { return size_t(width) * size_t(height); }
  /// Rays of all kinds: what the series cost, the same on every machine.
  double rays() const { return double(counters.closest_rays + counters.shadow_rays); }
  void add(const Image& image);
};

/// A scene and a method that are ready to render.
struct Experiment {
  const Scene& scene;
  FilmLayout layout;
  std::unique_ptr<Integrator> integrator;
};

/// Scenes and series of one row are kept, so that methods share their references.
class Laboratory {
 public:
  /// `cancelled` is asked between images; Cancelled is thrown when it says yes.
  Laboratory(int threads, std::function<bool()> cancelled);
  ~Laboratory();
  struct Cancelled {};

  int threads() const { return threads_; }
  void check_cancelled() const {
    if (cancelled_()) throw Cancelled();
  }
  /// Throws CatalogueError if the scene cannot be read or the method cannot be made.
  Experiment prepare(const SeriesPlan& plan);
  const Series& render(const SeriesPlan& plan);
  /// One image of a plan, by another number of threads than the laboratory's own if that matters.
  Image image(Experiment& experiment, const SeriesPlan& plan, int batch, int threads,
              RenderCounters& counters) const;

 private:
  struct BuiltScene;
  int threads_;
  std::function<bool()> cancelled_;
  std::map<std::string, std::unique_ptr<BuiltScene>> scenes_;
  std::map<std::string, Series> series_;
};

/// What the method under test renders in a variant of a row.
SeriesPlan subject_plan(const Row& row, const std::string& method, const Variant& variant);
/// What it is compared with, if that is not a value. The same seeds as the subject's if the
/// reference is the method itself.
SeriesPlan reference_plan(const Row& row, const std::string& method, const Variant& variant);
/// The series of the reference; sums are added up image by image.
Series render_reference(Laboratory& laboratory, const Row& row, const std::string& method,
                        const Variant& variant);

}  // namespace duet::stability
