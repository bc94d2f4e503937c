#include "evaluate/chart/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "base/seconds_text.h"
#include "evaluate/compare/linear_image.h"
#include "image/colours.h"
#include "image/image_io.h"
#include "math/statistics.h"

namespace duet {

namespace fs = std::filesystem;

namespace {

/// The field of the header in which a reference that was made says how.
constexpr const char* kHowMade = "howMade";

Image colour_image(int width, int height) {
  return Image(width, height, {"R", "G", "B"});
}

/// How an image was made, as far as its header says: by which program, and with how many samples
/// per pixel. `spp` is what is known of these otherwise, or 0.
std::string how_made(const LinearImage& image, double spp) {
  const auto field = [&](const char* name) {
    for (const auto& [key, value] : image.header)
      if (key == name) return value;
    return std::string();
  };
  if (const std::string note = field(kHowMade); !note.empty()) return note;
  std::string by;
  // Those of Duet, of Mitsuba, and what many other programs write.
  for (const char* name : {"program", "generatedBy", "Software", "software"})
    if (by.empty()) by = field(name);
  for (const char* name : {"version", "integrator"})
    if (const std::string text = field(name); !by.empty() && !text.empty()) by += " " + text;
  if (spp <= 0) spp = std::atof(image.spp.c_str());
  std::vector<std::string> parts;
  if (!by.empty()) parts.push_back("by " + by);
  if (spp > 0) parts.push_back(fmt::format("{} samples per pixel", spp));
  if (const double seconds = std::atof(field("renderSeconds").c_str()); seconds > 0)
    parts.push_back("in " + seconds_text(seconds));
  if (parts.empty()) return "its header does not say how it was made";
  return fmt::format("made {}", fmt::join(parts, ", "));
}

}  // namespace

ChartReference read_reference(const std::string& path, const std::string& variance, double spp) {
  ChartReference r;
  LinearImage mean = load_linear(path);
  r.source = fmt::format("{} ({}{}", path, how_made(mean, spp),
                         variance.empty() ? ")" : "; its variance subtracted)");
  r.mean = std::move(mean.image);
  if (variance.empty()) return r;
  if (spp <= 0) spp = std::atof(mean.spp.c_str());
  if (!(spp > 0)) throw UnknownSamples(UnknownSamples::Of::reference, path);
  r.variance = load_linear(variance).image;
  for (float& v : r.variance->data) v = float(v / spp);
  return r;
}

std::optional<ChartReference> make_reference(const ChartRender& render, Integrator& integrator,
                                             const std::string& name, double seconds) {
  constexpr int kParts = 8;
  // Numbers that no line of the chart uses.
  const uint64_t seed = render.seed + 0x5265666572656e63u;
  std::vector<Film> parts;
  integrator.begin(*render.scene, {render.layout.full, 64, render.threads});
  for (int i = 0; i < kParts; ++i)
    integrator.prepare(parts.emplace_back(render.layout, integrator.channels()));
  PassControl control;
  control.threads = render.threads;
  control.cancelled = [&] { return render.cancel->load(); };
  RenderCounters counters;
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  int spp = 0;
  for (int count = 1; spp == 0 || elapsed() * (1 + double(count) / spp) < seconds;) {
    for (int i = 0; i < kParts; ++i)
      integrator.render_pass(
          *render.scene, parts[size_t(i)],
          {SampleSequence::sobol, seed, uint32_t(i), uint32_t(spp), uint32_t(count)}, control,
          counters);
    if (control.cancelled()) return std::nullopt;
    spp += count;
    // A doubling if there is time for it, else what there is time for.
    count = int(std::clamp((seconds - elapsed()) / (elapsed() / spp), 1.0, double(spp)));
  }
  ChartReference r;
  const int width = render.layout.crop.width(), height = render.layout.crop.height();
  r.mean = colour_image(width, height);
  r.variance = colour_image(width, height);
  std::vector<Moments> moments(r.mean.data.size());
  for (const Film& film : parts) {
    const Image image = film.develop();
    const Colours colours(image);
    for (size_t i = 0; i < moments.size(); ++i) moments[i].add(colours(i / 3, int(i % 3)));
  }
  for (size_t i = 0; i < moments.size(); ++i) {
    r.mean.data[i] = float(moments[i].mean());
    r.variance->data[i] = float(moments[i].error() * moments[i].error());
  }
  r.source = fmt::format(
      "made by Duet itself with {} in {}, {} samples per pixel in {} independent parts, whose "
      "variance is subtracted",
      name, seconds_text(elapsed()), kParts * spp, kParts);
  r.caveat = "what this method cannot see or gets wrong is missing in it";
  return r;
}

void save_reference(const ChartReference& reference, const std::string& directory,
                    const std::string& command_line) {
  // As the variance of one sample of one.
  ExrOptions options;
  options.half = false;
  options.header = {{"program", "Duet"},
                    {"version", DUET_VERSION},
                    {"spp", 1},
                    {kHowMade, reference.source},
                    {"commandLine", command_line}};
  write_exr((fs::path(directory) / "reference.exr").string(), reference.mean, options);
  write_exr((fs::path(directory) / "reference-variance.exr").string(), *reference.variance,
            options);
}

}  // namespace duet
