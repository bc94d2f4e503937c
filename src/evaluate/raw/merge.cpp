#include "evaluate/raw/merge.h"

#include <algorithm>

#include "base/diagnostics.h"
#include "base/memory_limit.h"
#include "evaluate/report/memory_estimate.h"

namespace duet {

namespace {

uint32_t first_sample(const RawFilm& film) {
  const auto& all = film.state().samples.all();
  return all.empty() ? 0 : all.front().first;
}

void check(const RawFilm& first, const RawFilm& other) {
  if (const std::string what = difference(other.image(), first.image()); !what.empty())
    throw ReadError(
        fmt::format("{}: is not of the same image: {} as in {}", other.path(), what, first.path()));
  if (first.image().target_error)
    throw ReadError(
        fmt::format("{}: a render with --target-error is one film and cannot be merged with {}",
                    other.path(), first.path()));
}

void check_overlaps(const std::vector<RawFilm>& films) {
  for (size_t i = 0; i < films.size(); ++i)
    for (size_t k = 0; k < i; ++k)
      for (const SampleInterval& own : films[i].state().samples.all())
        if (films[k].state().samples.overlaps(own))
          throw ReadError(fmt::format("{}: the samples {} overlap those of {}, {}", films[i].path(),
                                      to_string(own), films[k].path(),
                                      to_string(films[k].state().samples.all())));
}

void check_memory(const RawImage& image) {
  const size_t films = image.target_error ? kErrorBatches : 1;
  const MemoryEstimate estimate = estimate_memory(image.contents, image.form.full_precision.size(),
                                                  image.layout, films, image.form.half);
  const std::string why = memory_refusal(estimate, memory_in_use(), memory_limit());
  if (!why.empty()) throw TooLittleMemory(why);
}

}  // namespace

MergedFilms merge_raw_films(const std::vector<std::string>& paths) {
  std::vector<RawFilm> films;
  for (const std::string& path : paths) {
    films.emplace_back(path);
    if (films.size() > 1) check(films.front(), films.back());
  }
  check_overlaps(films);
  check_memory(films.front().image());
  std::stable_sort(films.begin(), films.end(), [](const RawFilm& a, const RawFilm& b) {
    return first_sample(a) < first_sample(b);
  });
  MergedFilms merged{films.front().image(), {}, {}, films.size(), {}};
  RenderState& state = merged.state;
  std::optional<PartialMeans> parts;
  for (const RawFilm& film : films) {
    film.add_to(state);
    if (state.films.size() > 1) continue;
    if (!parts) parts.emplace(state.films[0]);
    parts->add_part(state.films[0]);
  }
  merged.gaps = state.samples.gaps();
  merged.result = develop(state);
  if (state.films.size() > 1) {
    merged.result.relative_rmse = batch_relative_rmse(state.films);
    return merged;
  }
  // From the parts of each film, and from what the films differ by.
  state.variance.squares += parts->variance().squares;
  state.variance.count += parts->variance().count;
  parts->set_variance(state.variance);
  merged.result.relative_rmse = parts->relative_rmse();
  merged.result.rmse_is_upper_bound = merged.image.sampler != "independent";
  return merged;
}

RenderRecord record_of(const MergedFilms& merged) {
  RenderRecord record;
  record.scene_file = fmt::format("{} raw films", merged.films);
  record.integrator = merged.image.integrator;
  record.decision = merged.image.decision;
  record.noise_only = merged.image.noise_only;
  record.seed = merged.image.seed;
  return record;
}

HeaderFields header_of(const MergedFilms& merged, const RenderRecord& record,
                       const std::string& gaps) {
  HeaderFields header = merged.image.header;
  for (HeaderField& field : samples_header(record, merged.result))
    header.push_back(std::move(field));
  header.emplace_back("slices", int(merged.films));
  if (!gaps.empty()) header.emplace_back("missingSamples", gaps);
  return header;
}

}  // namespace duet
