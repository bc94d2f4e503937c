// How often the test for bias calls an unbiased image biased, and how often it finds a defect.
//
//   calibrate_compare SCENE.xml REFERENCE METHOD SEQUENCE FIRST_SEED SEEDS SPP[:WxH]...
//                     [--defects] [--clamp] [NAME=VALUE...]
//
// REFERENCE is a folder with mean.exr and variance.exr (docs/references.md); METHOD is `scene` for
// what the scene names, or as after `duet -i`; SEQUENCE is sobol or independent. For every number
// of samples and every seed it renders the scene, or a window of this size in its middle, and
// prints a line of values with commas between them:
//
//   spp, seed, width, height, p of the image, p of the image 1 % too dark, lit tiles, tiles that
//   were noticed when 5 % too dark, p of the image without what clamping takes, share of light that
//   it takes from the image, from the tile that loses most
//
// The last six are -1 without --defects and --clamp. Tiles are lit that have a tenth of the mean
// brightness. Clamping means that every sample of a pixel is cut at four times the mean of the
// reference, as renderers do against fireflies, but for pixels that are brighter than that
// themselves. bench/calibrate_compare.py runs this for all references.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "image/bias_test.h"
#include "image/image_io.h"
#include "integrators/make_integrator.h"
#include "integrators/pass.h"
#include "mitsuba/mitsuba.h"
#include "scene/build.h"

namespace {

using namespace duet;

constexpr int kTiles = 8;
constexpr float kClamp = 4;   // times the mean
constexpr double kLit = 0.1;  // times the mean

struct Prepared {
  FilmLayout layout;
  std::unique_ptr<Integrator> integrator;
  std::unique_ptr<Scene> scene;
};

Prepared prepare(const std::string& path, const std::string& method,
                 std::vector<std::pair<std::string, std::string>> defines) {
  Diagnostics diagnostics;
  MitsubaOptions options;
  options.defines = std::move(defines);
  auto read = read_mitsuba(path, options, diagnostics);
  if (!read) throw std::runtime_error("cannot read " + path);
  SceneDescription& d = read->description;
  const FilmDescription& film = d.sensors.at(0).film;
  Prepared p;
  p.layout = {{film.width, film.height}, {0, 0, film.width, film.height}, film.filter};
  p.layout.ends_at_crop = film.crop.has_value();
  if (film.crop)
    p.layout.crop = {film.crop->x, film.crop->y, film.crop->x + film.crop->width,
                     film.crop->y + film.crop->height};
  if (method != "scene") {
    IntegratorOverride other;
    other.name = method;
    apply_override(d.integrator, other);
  }
  p.integrator = make_integrator(d.integrator);
  BuildOptions build;
  build.threads = 1;
  build.layer_needs = integrator_needs(d.integrator);
  p.scene = build_scene(std::move(d), build, diagnostics);
  if (!p.scene) throw std::runtime_error("cannot build " + path);
  return p;
}

/// The part of an image that starts at x, y.
Image window(const Image& image, int x, int y, int width, int height) {
  Image part(width, height, image.channels);
  for (int row = 0; row < height; ++row)
    std::copy_n(image.pixel(x, y + row), size_t(width) * image.channels.size(), part.pixel(0, row));
  return part;
}

double sum_of(const Image& image, int x0, int y0, int x1, int y1) {
  double sum = 0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      for (size_t c = 0; c < 3; ++c) sum += image.pixel(x, y)[c];
  return sum;
}

void scale(Image& image, float factor, int x0, int y0, int x1, int y1) {
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      for (size_t c = 0; c < image.channels.size(); ++c) image.pixel(x, y)[c] *= factor;
}

template <class F>
void for_each_tile_of(const Image& image, const F& f) {
  for (int row = 0; row < kTiles; ++row)
    for (int column = 0; column < kTiles; ++column)
      f(column * image.width / kTiles, row * image.height / kTiles,
        (column + 1) * image.width / kTiles, (row + 1) * image.height / kTiles);
}

class Calibration {
 public:
  Calibration(Prepared prepared, const std::string& reference, SampleSequence sequence)
      : prepared_(std::move(prepared)), sequence_(sequence) {
    const ImageFile file = read_image(reference + "/mean.exr");
    full_mean_ = file.image;
    full_variance_ = read_image(reference + "/variance.exr").image;
    for (const auto& [name, value] : file.header)
      if (name == "spp") reference_spp_ = std::atof(value.c_str());
  }

  /// Of the middle of the image, width × height pixels, or all of it for 0.
  void set_window(int width, int height) {
    const int w = width > 0 ? std::min(width, full_mean_.width) : full_mean_.width;
    const int h = height > 0 ? std::min(height, full_mean_.height) : full_mean_.height;
    const int x = (full_mean_.width - w) / 2, y = (full_mean_.height - h) / 2;
    mean_ = window(full_mean_, x, y, w, h);
    variance_ = window(full_variance_, x, y, w, h);
    layout_ = prepared_.layout;
    layout_.crop.x0 += x, layout_.crop.y0 += y;
    layout_.crop.x1 = layout_.crop.x0 + w, layout_.crop.y1 = layout_.crop.y0 + h;
  }

  void measure(int spp, int seed, bool defects, bool clamping) const {
    const Image image = render_image(spp, uint64_t(seed));
    fmt::print("{},{},{},{},{:.4g}", spp, seed, image.width, image.height, test(image, spp));
    if (defects)
      measure_defects(image, spp);
    else
      fmt::print(",-1,-1,-1");
    if (clamping)
      measure_clamping(spp, seed);
    else
      fmt::print(",-1,-1,-1");
    fmt::print("\n");
    std::fflush(stdout);
  }

 private:
  Image render_image(int spp, uint64_t seed) const {
    RenderRequest request;
    request.budget.spp = spp;
    // Numbers of samples are independent of one another, too.
    request.seed = seed * 4096 + uint64_t(spp);
    request.sequence = sequence_;
    return render(*prepared_.scene, *prepared_.integrator, layout_, request).image;
  }

  double test(const Image& image, int spp) const {
    return test_bias(image, mean_, NoiseModel{&variance_, double(spp), reference_spp_}).p;
  }

  void measure_defects(const Image& image, int spp) const {
    Image dark = image;
    scale(dark, 0.99f, 0, 0, image.width, image.height);
    int lit = 0, noticed = 0;
    const double mean = sum_of(mean_, 0, 0, mean_.width, mean_.height) / mean_.width / mean_.height;
    for_each_tile_of(image, [&](int x0, int y0, int x1, int y1) {
      if (sum_of(mean_, x0, y0, x1, y1) <= kLit * mean * (x1 - x0) * (y1 - y0)) return;
      Image darker = image;
      scale(darker, 0.95f, x0, y0, x1, y1);
      ++lit, noticed += test(darker, spp) < kBiasSignificance;
    });
    fmt::print(",{:.4g},{},{}", test(dark, spp), lit, noticed);
  }

  void measure_clamping(int spp, int seed) const {
    const double pixels = double(mean_.width) * mean_.height;
    const float limit = kClamp * float(sum_of(mean_, 0, 0, mean_.width, mean_.height) / pixels / 3);
    Image clamped(mean_.width, mean_.height, {"R", "G", "B"}), plain = clamped;
    for (int i = 0; i < spp; ++i) {
      // Seeds of other images than those that are tested unclamped.
      const Image one = render_image(1, uint64_t(seed) * 1000003 + uint64_t(i));
      for (int y = 0; y < one.height; ++y)
        for (int x = 0; x < one.width; ++x)
          for (int c = 0; c < 3; ++c) {
            const float value = one.pixel(x, y)[c];
            const bool bright = mean_.pixel(x, y)[c] > limit;
            plain.pixel(x, y)[c] += value / float(spp);
            clamped.pixel(x, y)[c] += (bright ? value : std::min(value, limit)) / float(spp);
          }
    }
    const auto loss = [&](int x0, int y0, int x1, int y1) {
      const double all = sum_of(plain, x0, y0, x1, y1);
      return all > 0 ? 1 - sum_of(clamped, x0, y0, x1, y1) / all : 0;
    };
    double worst = 0;
    for_each_tile_of(plain, [&](int x0, int y0, int x1, int y1) {
      worst = std::max(worst, loss(x0, y0, x1, y1));
    });
    fmt::print(",{:.4g},{:.4g},{:.4g}", test(clamped, spp), loss(0, 0, plain.width, plain.height),
               worst);
  }

  Prepared prepared_;
  SampleSequence sequence_;
  Image full_mean_, full_variance_, mean_, variance_;
  double reference_spp_ = 1;
  FilmLayout layout_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 8) {
    fmt::print(stderr, "calibrate_compare: see the head of bench/calibrate_compare.cpp\n");
    return 2;
  }
  std::vector<std::string> jobs;
  std::vector<std::pair<std::string, std::string>> defines;
  bool defects = false, clamping = false;
  for (int i = 7; i < argc; ++i) {
    const std::string text = argv[i];
    if (text == "--clamp")
      clamping = true;
    else if (text == "--defects")
      defects = true;
    else if (const size_t at = text.find('='); at != std::string::npos)
      defines.emplace_back(text.substr(0, at), text.substr(at + 1));
    else
      jobs.push_back(text);
  }
  try {
    Calibration calibration(
        prepare(argv[1], argv[3], defines), argv[2],
        std::string(argv[4]) == "sobol" ? SampleSequence::sobol : SampleSequence::independent);
    const int first = std::atoi(argv[5]), seeds = std::atoi(argv[6]);
    for (const std::string& job : jobs) {
      int spp = 0, width = 0, height = 0;
      std::sscanf(job.c_str(), "%d:%dx%d", &spp, &width, &height);
      calibration.set_window(width, height);
      for (int seed = first; seed < first + seeds; ++seed) {
        calibration.measure(spp, seed, defects, clamping);
      }
    }
  } catch (const std::exception& e) {
    fmt::print(stderr, "calibrate_compare: {}\n", e.what());
    return 1;
  }
}
