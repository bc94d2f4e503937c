// What has no noise: bits, pixels that are not numbers, counts; and images that were stopped early.
#include <fmt/format.h>

#include <atomic>
#include <cmath>

#include "app/stability/checks.h"
#include "math/hash.h"
#include "math/sampler.h"

namespace duet::stability {

Measurement measure_bits(const Cell& cell) {
  return worst_variant(cell, [&](const Variant& v) {
    const SeriesPlan plan = subject_plan(cell.row, cell.method, v);
    Measurement m;
    Image one;
    for (const int threads : {1, 2, 7}) {
      Experiment e = cell.laboratory.prepare(plan);
      RenderCounters counters;
      Image image = cell.laboratory.image(e, plan, 0, threads, counters);
      if (threads == 1) {
        one = std::move(image);
        continue;
      }
      for (size_t i = 0; i < image.data.size(); i += image.channels.size()) {
        bool differs = false;
        for (size_t c = 0; c < image.channels.size(); ++c)
          differs |= image.data[i + c] != one.data[i + c];
        m.value += differs;
      }
    }
    m.holds = m.value < cell.limit;
    return m;
  });
}

namespace {

/// The variants that a row draws at random, always the same ones.
std::vector<Variant> drawn_variants(const Row& row) {
  std::vector<Variant> variants;
  for (int i = 0; i < row.draw.count; ++i) {
    Variant v;
    v.label = fmt::format("scene {}", i + 1);
    uint64_t number = 0;
    for (const Draw::Name& n : row.draw.names) {
      const float u = to_unit_float(uint32_t(mix64(hash_combine(uint64_t(i), number++)) >> 32));
      v.defines[n.name] =
          n.texts.empty()
              ? fmt::format("{:.6g}", n.least * std::pow(n.most / n.least, double(u)))
              : n.texts[std::min(n.texts.size() - 1, size_t(u * float(n.texts.size())))];
    }
    variants.push_back(std::move(v));
  }
  return variants;
}

}  // namespace

Measurement measure_finite(const Cell& cell) {
  Row row = cell.row;
  for (Variant& v : drawn_variants(cell.row)) row.variants.push_back(std::move(v));
  const Cell drawn{row, cell.method, cell.laboratory, cell.level, cell.limit};
  long pixels = 0;
  Measurement worst = worst_variant(drawn, [&](const Variant& v) {
    const Series& s = cell.laboratory.render(subject_plan(row, cell.method, v));
    pixels += long(s.pixels() * s.images.size());
    Measurement m;
    m.value = double(s.bad_pixels);
    m.holds = m.value < cell.limit;
    require_finite(s, m);
    return m;
  });
  worst.detail = worst.holds ? fmt::format("{} pixels of {} scenes", pixels, row.variants.size())
                             : worst.detail;
  return worst;
}

Measurement measure_crowding(const Cell& cell) {
  return worst_variant(cell, [&](const Variant& v) {
    const Series& s = cell.laboratory.render(subject_plan(cell.row, cell.method, v));
    Measurement m;
    m.value = double(s.counters.merges) / double(std::max<uint64_t>(1, s.counters.merge_queries));
    m.holds = m.value < cell.limit;
    require_finite(s, m);
    return m;
  });
}

Measurement measure_stops(const Cell& cell) {
  return worst_variant(cell, [&](const Variant& v) {
    const SeriesPlan plan = subject_plan(cell.row, cell.method, v);
    Experiment e = cell.laboratory.prepare(plan);
    Series series;
    for (int b = 0; b < plan.batches; ++b) {
      cell.laboratory.check_cancelled();
      Film film(e.layout, e.integrator->channels());
      e.integrator->prepare(film);
      // Every question counts, so that the stop comes in the midst of a pass; on one thread it
      // always comes at the same place.
      const double share = double(to_unit_float(mix32(uint32_t(b))));
      const int questions = 1 + int(share * plan.spp * double(film.tiles().size()));
      std::atomic<int> asked = 0;
      PassControl control;
      control.cancelled = [&] { return ++asked > questions; };
      const SampleRange range{SampleSequence::sobol, plan.batch_seed(b), 0, 0, uint32_t(plan.spp)};
      // A whole pass first: every pixel is to have a sample.
      PassControl whole;
      whole.threads = cell.laboratory.threads();
      SampleRange first = range, rest = range;
      first.count = 1, rest.first = 1;
      e.integrator->render_pass(e.scene, film, first, whole, series.counters);
      e.integrator->render_pass(e.scene, film, rest, control, series.counters);
      Image image = film.develop();
      e.integrator->finish(image, 1);
      series.add(image);
    }
    return compare_energy(cell, series, v);
  });
}

}  // namespace duet::stability
