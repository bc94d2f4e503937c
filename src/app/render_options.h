// The options of `duet render`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/progress.h"
#include "app/scene_file.h"
#include "base/tcp.h"
#include "image/tone_curve.h"
#include "integrators/make_integrator.h"

namespace CLI {
class App;
}

namespace duet {

struct Program;

struct RenderOptions {
  ReadOptions read;
  std::vector<std::string> outputs;
  std::string extension = ".exr";  ///< of images whose names have none
  DisplaySettings display;
  bool skip_existing = false, keep_going = true;
  bool keep_partial_name = false, require_target = false;
  bool denoise = false;  ///< whether there is a denoised image beside each image

  IntegratorOverride integrator;
  RenderBudget budget;
  std::optional<Point2i> size;
  std::optional<PixelBounds> crop;
  size_t sensor = 0;
  std::optional<uint64_t> seed;
  int threads = 0;
  bool strict_sampler = false;
  TechniqueOutput techniques = TechniqueOutput::none;

  std::string raw;                   ///< where raw films go, as a template
  std::string resume;                ///< a raw film to go on from
  std::optional<double> checkpoint;  ///< seconds between raw films
  std::optional<SampleInterval> samples;
  struct Slice {
    uint32_t number = 1, of = 1;
  };
  std::optional<Slice> slice;  ///< of the samples
  /// Whether images are written: not if there are only raw films to write.
  bool writes_images = true;

  std::string stats_file, log_file;
  bool quiet = false, verbose = false;
  ProgressStyle progress = ProgressStyle::automatic;
  std::optional<TcpPeer> viewer;  ///< that shows the image as it grows
};

/// Adds the options to a command; `finish` is to be called once they are parsed and throws
/// UsageError for values that make no sense.
class RenderOptionParser {
 public:
  RenderOptionParser(CLI::App& command, Program& program);
  RenderOptions finish();

 private:
  void add_method_options(CLI::App& command);
  void add_image_options(CLI::App& command);
  void add_output_options(CLI::App& command);
  void add_raw_options(CLI::App& command);
  void finish_numbers();
  void finish_window();
  void finish_format();
  void finish_raw();
  void check_standard_output() const;
  void check_outputs() const;

  Program& program_;
  RenderOptions options_;
  std::string spp_, time_, target_, size_, crop_,
      exposure_ = "0", tone_map_, threads_, seed_, sensor_, progress_ = "auto", techniques_,
      format_, light_selection_, checkpoint_, samples_, slice_, viewer_;
  std::vector<std::string> integrator_parameters_, layers_;
};

}  // namespace duet
