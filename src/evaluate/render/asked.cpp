#include "evaluate/render/asked.h"

#include <fmt/format.h>

#include "base/failures.h"
#include "scene/film_layout.h"

namespace duet {

FilmLayout asked_layout(FilmDescription& film, const RenderOptions& options) {
  try {
    return film_layout(film, options.size, options.crop);
  } catch (const std::out_of_range& e) {
    throw UsageError(fmt::format("--crop: {}", e.what()));
  }
}

void check_window(const RenderOptions& options) {
  if (!options.size || !options.crop) return;
  FilmDescription any;
  asked_layout(any, options);
}

std::optional<SampleInterval> asked_samples(const RenderOptions& options, int spp) {
  if (!options.slice) return options.samples;
  const auto [number, of] = *options.slice;
  if (of > uint32_t(spp))
    throw UsageError(
        fmt::format("--slice {}/{}: {} samples per pixel have no {} parts", number, of, spp, of));
  return slice_of(uint32_t(spp), number, of);
}

void add_settings(Fingerprint& settings, const RenderRecord& record, const RenderRequest& request,
                  const RenderOptions& options, const FilmLayout& layout,
                  const std::vector<std::string>& channels) {
  const RenderBudget& budget = request.budget;
  const PixelBounds& crop = layout.crop;
  settings.add(fmt::format("{} {}, sensor {}, techniques {}", record.integrator,
                           record.integrator_parameters, options.sensor, int(options.techniques)));
  for (const std::string& channel : channels) settings.add(channel);
  settings.add(fmt::format("{} spp, {} s, error {}", budget.spp.value_or(0),
                           budget.seconds.value_or(0), budget.target_error.value_or(0)));
  if (request.samples) settings.add("samples " + to_string(*request.samples));
  settings.add(fmt::format("{} seed {}", record.sampler, record.seed));
  settings.add(fmt::format("{} {} {} {} {} {} {}", layout.full.x, layout.full.y, crop.x0, crop.y0,
                           crop.x1, crop.y1, layout.ends_at_crop));
}

}  // namespace duet
