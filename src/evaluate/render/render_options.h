// What is asked of rendering scenes, besides what they say themselves.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/system/tcp.h"
#include "evaluate/render/scene_file.h"
#include "evaluate/report/file_settings.h"
#include "image/cryptomatte.h"
#include "integrators/make_integrator.h"
#include "integrators/pass.h"

namespace duet {

struct RenderOptions {
  ReadOptions read;
  std::vector<std::string> outputs;
  std::string extension = ".exr";  ///< of images whose names have none
  FileSettings files;
  bool skip_existing = false;
  bool keep_partial_name = false;
  bool denoise = false;  ///< whether there is a denoised image beside each image
  std::vector<MatteKind> mattes;

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
  std::optional<TcpPeer> viewer;  ///< that shows the image as it grows
};

}  // namespace duet
