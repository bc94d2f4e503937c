// Renders the series of images that the checks of the stability table look at.
#pragma once

#include <functional>
#include <memory>

#include "evaluate/stability/catalogue.h"
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
  std::optional<double> target_error;
  /// Tells plans apart; those of one key are the same but for their number of images.
  std::string key() const;
  uint64_t batch_seed(int batch) const;
};

/// An image of a series; each pixel is the mean of its three colours.
struct Picture {
  std::vector<float> grey;
  int bad_pixels = 0;  ///< not finite or negative
  RenderCounters counters;
};

/// Independent images of one scene by one method.
struct Series {
  int width = 0, height = 0;
  std::string method;  ///< that made them: of `auto`, the one that it took
  std::vector<Picture> pictures;
  size_t pixels() const { return size_t(width) * size_t(height); }
  RenderCounters counters() const;
  long bad_pixels() const;
  /// Rays of all kinds: what the series cost, the same on every machine.
  double rays() const;
  void add(const Image& image, const RenderCounters& counters);
  /// The first `count` images.
  Series first(size_t count) const;
  /// All but every `groups`-th image from the `group`-th on.
  Series without(int group, int groups) const;
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
  /// The images of a plan. Those that another plan of the same key has made are not made again.
  Series render(const SeriesPlan& plan);
  /// Adds images to a series until it has as many as the plan says. `one` makes that of a batch,
  /// with an experiment that no other thread has.
  void extend(Series& series, const SeriesPlan& plan,
              const std::function<Image(Experiment&, int batch, RenderCounters&)>& one);
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
/// The series of the reference, with so many images if `batches` is not 0; sums are added up image
/// by image.
Series render_reference(Laboratory& laboratory, const Row& row, const std::string& method,
                        const Variant& variant, int batches = 0);

}  // namespace duet::stability
