// What has no noise: bits, pixels that are not numbers, counts; and images that were stopped early.
#include <fmt/format.h>

#include <atomic>
#include <cmath>

#include "evaluate/stability/checks.h"
#include "math/hash.h"
#include "math/sampler.h"

namespace duet::stability {

namespace {

Power exact_power(const Cell& cell) {
  return {cell.limit, cell.limit, 0};
}

}  // namespace

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
    m.power = exact_power(cell);
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
  const Cell drawn{row, cell.method, cell.laboratory, cell.level, cell.limit, cell.margin};
  long pixels = 0;
  Measurement worst = worst_variant(drawn, [&](const Variant& v) {
    const Series s = cell.laboratory.render(subject_plan(row, cell.method, v));
    pixels += long(s.pixels() * s.pictures.size());
    Measurement m;
    m.value = double(s.bad_pixels());
    m.holds = m.value < cell.limit;
    m.power = exact_power(cell);
    require_finite(s, m);
    return m;
  });
  worst.detail = worst.holds ? fmt::format("{} pixels of {} scenes", pixels, row.variants.size())
                             : worst.detail;
  return worst;
}

Measurement measure_crowding(const Cell& cell) {
  return worst_variant(cell, [&](const Variant& v) {
    const Series s = cell.laboratory.render(subject_plan(cell.row, cell.method, v));
    const RenderCounters counters = s.counters();
    Measurement m;
    m.value = double(counters.merges) / double(std::max<uint64_t>(1, counters.merge_queries));
    m.holds = m.value < cell.limit;
    m.power = exact_power(cell);
    require_finite(s, m);
    return m;
  });
}

namespace {

/// An image that was stopped after a random number of tiles, but not before every pixel had a
/// sample.
Image stopped_image(const SeriesPlan& plan, int batch, Experiment& e, RenderCounters& counters) {
  Film film(e.layout, e.integrator->channels());
  e.integrator->prepare(film);
  // Every question counts, so that most stops come in the midst of a pass; on one thread they
  // always come at the same place.
  const double share = double(to_unit_float(mix32(uint32_t(batch))));
  const int questions = 1 + int(share * plan.spp * double(film.tiles().size()));
  std::atomic<int> asked = 0;
  PassControl whole, stopped;
  stopped.cancelled = [&] { return ++asked > questions; };
  for (int sample = 0; sample < plan.spp && asked <= questions; ++sample) {
    const SampleRange range{SampleSequence::sobol, plan.batch_seed(batch), 0, uint32_t(sample), 1};
    e.integrator->render_pass(e.scene, film, range, sample == 0 ? whole : stopped, counters);
  }
  return film.develop();
}

}  // namespace

Measurement measure_stops(const Cell& cell) {
  return worst_variant(cell, [&](const Variant& v) {
    Series series;
    return measure_resolved(cell, [&](int batches) {
      SeriesPlan plan = subject_plan(cell.row, cell.method, v);
      plan.batches = batches;
      cell.laboratory.extend(series, plan, [&](Experiment& e, int batch, RenderCounters& counters) {
        cell.laboratory.check_cancelled();
        return stopped_image(plan, batch, e, counters);
      });
      return compare_energy(cell, series, v);
    });
  });
}

}  // namespace duet::stability
