#include "app/chart_reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "app/commands.h"
#include "app/compare.h"
#include "app/output.h"
#include "app/placeholders.h"
#include "app/progress.h"
#include "image/colours.h"

namespace duet {

namespace fs = std::filesystem;

namespace {

std::string path_of(const char* option, const std::vector<std::string>& given, size_t index,
                    const std::string& scene) {
  const OutputNames names = output_names(scene);
  return fill_in(option, given.size() == 1 ? given[0] : given[index],
                 {{"scene", names.scene}, {"folder", names.folder}});
}

Image colour_image(int width, int height) {
  return Image(width, height, {"R", "G", "B"});
}

}  // namespace

ChartReference read_reference(const ChartOptions& o, size_t index) {
  const std::string& scene = o.read.scenes[index];
  const std::string path = path_of("--reference", o.references, index, scene);
  ChartReference r;
  LinearImage mean = load_linear(path);
  r.source = path;
  r.mean = std::move(mean.image);
  if (o.variances.empty()) return r;
  const double spp = o.reference_spp > 0 ? o.reference_spp : std::atof(mean.spp.c_str());
  if (!(spp > 0))
    throw UsageError(
        fmt::format("--variance also needs --reference-spp: the header of {} does not say how many "
                    "samples it has",
                    path));
  r.variance = load_linear(path_of("--variance", o.variances, index, scene)).image;
  for (float& v : r.variance->data) v = float(v / spp);
  r.source += fmt::format(", {} samples per pixel, its variance subtracted", spp);
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
    Image image = film.develop();
    integrator.finish(image, spp);
    const Colours colours(image);
    for (size_t i = 0; i < moments.size(); ++i) moments[i].add(colours(i / 3, int(i % 3)));
  }
  for (size_t i = 0; i < moments.size(); ++i) {
    r.mean.data[i] = float(moments[i].mean());
    r.variance->data[i] = float(moments[i].error() * moments[i].error());
  }
  r.source = fmt::format(
      "made by Duet itself with {} in {}, {} samples per pixel in {} independent parts, whose "
      "variance is subtracted; what this method cannot see or gets wrong is missing in it",
      name, format_seconds(elapsed()), kParts * spp, kParts);
  return r;
}

void save_reference(const ChartReference& reference, const std::string& directory) {
  // As the variance of one sample of one.
  ExrOptions options;
  options.half = false;
  options.header = {{"program", "Duet"}, {"spp", 1}, {"commandLine", command_line}};
  write_exr((fs::path(directory) / "reference.exr").string(), reference.mean, options);
  write_exr((fs::path(directory) / "reference-variance.exr").string(), *reference.variance,
            options);
}

}  // namespace duet
