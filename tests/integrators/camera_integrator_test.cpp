// The sums of a film, by the methods that fill it.
#include "integrators/camera_integrator.h"

#include <doctest/doctest.h>

#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

/// A room with a lamp and a mirror, small enough for many renders.
std::string lit_room() {
  return camera_xml("0,-3,1", "0,0,1", 20) + room_xml(grey("0.7, 0.5, 0.3")) +
         sphere_xml("0.3,0.2,0.5", "0.4", "<bsdf type='conductor'/>") +
         sphere_xml("-0.3,0.2,1.6", "0.2",
                    "<emitter type='area'><rgb name='radiance' value='9,7,5'/></emitter>");
}

/// Nothing but light of one brightness from everywhere.
std::string constant_light() {
  return camera_xml("0,-3,1", "0,0,1", 1) +
         "<emitter type='constant'><rgb name='radiance' value='0.1'/></emitter>";
}

/// All sums of a film, whose bits the rounding to an image would hide, and the image.
std::vector<ExactSum> sums(const Film& film) {
  std::vector<ExactSum> all;
  for (const FilmTile& tile : film.tiles())
    all.insert(all.end(), tile.sums().begin(), tile.sums().end());
  for (const float v : film.develop().data) all.emplace_back().add(double(v));
  return all;
}

/// The film after these passes, which follow each other.
Film after_passes(const TransportScene& s, Integrator& method, const FilmLayout& layout,
                  const std::vector<uint32_t>& passes, std::span<const TileSamples> tiles = {}) {
  method.begin(*s.scene, {layout.full, 12, 2});
  Film film(layout, method.channels());
  method.prepare(film);
  SampleRange all{SampleSequence::sobol, 5, 0, 0, 12, tiles};
  std::vector<TileSamples> of_pass;
  RenderCounters counters;
  uint32_t done = 0;
  for (const uint32_t n : passes) {
    PassControl control;
    control.threads = 2;
    method.render_pass(*s.scene, film, part_of(all, done, n, of_pass), control, counters);
    done += n;
  }
  REQUIRE(done == 12);
  return film;
}

}  // namespace

TEST_CASE("the image is the same bit for bit however its samples are divided into passes") {
  const TransportScene s(lit_room());
  for (const FilterKind kind : {FilterKind::box, FilterKind::gaussian})
    for (const char* name : {"path", "bdpt", "vcm"}) {
      CAPTURE(name);
      CAPTURE(int(kind));
      FilmLayout layout = s.layout;
      layout.filter = {};
      layout.filter.kind = kind;
      // More samples for some tiles than for others, as an adaptive render deals them out.
      const std::vector<TileSamples> uneven{{0, 12}, {3, 5}, {0, 0}, {7, 12}};
      for (const bool even : {true, false}) {
        const std::span<const TileSamples> tiles = even ? std::span<const TileSamples>{} : uneven;
        const auto render = [&](const std::vector<uint32_t>& passes) {
          const auto method = s.method(name, {{"max_depth", "4"}});
          return sums(after_passes(s, *method, layout, passes, tiles));
        };
        const std::vector<ExactSum> whole = render({12});
        CHECK(std::any_of(whole.begin(), whole.end(),
                          [](const ExactSum& sum) { return sum.value() > 0; }));
        CHECK(render({1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}) == whole);
        CHECK(render({1, 2, 4, 5}) == whole);
      }
    }
}

TEST_CASE("a constant stays one however many samples it has") {
  const TransportScene s(constant_light());
  const RenderResult r = s.render("path", {}, 1 << 20, 1);
  CHECK(r.spp == 1 << 20);
  CHECK(r.image.pixel(0, 0)[0] == 0.1f);
}
