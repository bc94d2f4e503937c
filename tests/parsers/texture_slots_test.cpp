// Every texture in every parameter that may be one: what Mitsuba 3 takes is taken, and is as
// bright.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <optional>

#include "integrators/make_integrator.h"
#include "integrators/pass.h"
#include "math/statistics.h"
#include "mitsuba/mitsuba.h"
#include "scene/build.h"
#include "support/files.h"
#include "support/source_path.h"
#include "support/tables.h"

using namespace duet;
using namespace duet::test;

namespace {

const std::string kSlotsFolder = source_path("reference/slots/");

void replace(std::string& text, const std::string& what, const std::string& by) {
  const size_t at = text.find(what);
  REQUIRE(at != text.npos);
  text.replace(at, what.size(), by);
}

/// The scene of the table with a texture in a slot.
std::string scene_text(const Json& table, const std::string& slot, const std::string& texture) {
  const Json& s = table["slots"][slot];
  std::string text = table["scenes"][s["scene"].get<std::string>()];
  replace(text, "PLUGIN", s["plugin"]);
  replace(text, "SLOT", table["textures"][texture]);
  replace(text, "NAME", "name=\"" + s["parameter"].get<std::string>() + "\"");
  return text;
}

std::string messages(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& d : diagnostics.all()) text += d.message + "; ";
  return text;
}

/// The mean of each channel in several independent images; nothing if the scene is refused, with
/// the reason in `refusal`.
std::optional<std::array<Moments, 3>> render_means(const std::string& text, std::string& refusal) {
  constexpr int kImages = 4, kSamples = 8;
  const std::string path = kSlotsFolder + "scene.xml";
  MitsubaOptions options;
  options.files.read = [&](const std::string& file) -> std::optional<std::string> {
    return file == path ? text : read_file(file);
  };
  options.files.exists = [&](const std::string& file) {
    return file == path || std::filesystem::exists(file);
  };
  Diagnostics diagnostics;
  auto read = read_mitsuba(path, options, diagnostics);
  refusal = messages(diagnostics);
  if (!read) return std::nullopt;
  SceneDescription& d = read->description;
  const auto integrator = make_integrator(d.integrator);
  const FilmDescription film = d.sensors.at(0).film;
  const auto scene = build_scene(std::move(d), {}, diagnostics);
  refusal = messages(diagnostics);
  if (!scene) return std::nullopt;
  std::array<Moments, 3> means;
  for (int i = 0; i < kImages; ++i) {
    RenderRequest request;
    request.budget.spp = kSamples;
    request.seed = uint64_t(i);
    const Point2i size{film.width, film.height};
    const Image image =
        render(*scene, *integrator, {size, {0, 0, size.x, size.y}, film.filter}, request).image;
    for (size_t c = 0; c < 3; ++c) {
      double sum = 0;
      for (size_t p = c; p < image.data.size(); p += image.channels.size())
        sum += double(image.data[p]);
      means[c].add(sum / (size.x * size.y));
    }
  }
  return means;
}

}  // namespace

TEST_CASE("what Mitsuba takes as a texture is taken and means the same") {
  const Json table = Json::parse(read_file(kSlotsFolder + "slots.json"));
  int count = 0;
  for (const auto& answers : table["results"].items())
    for (const auto& asked : answers.value().items()) {
      const std::string &slot = answers.key(), &texture = asked.key();
      const Json& answer = asked.value();
      INFO(slot << " = " << texture);
      std::string refusal;
      const auto means = render_means(scene_text(table, slot, texture), refusal);
      ++count;
      CHECK_MESSAGE(means, refusal);
      if (!means) continue;
      for (size_t c = 0; c < 3; ++c) {
        const Moments& m = (*means)[c];
        const double expected = answer[c], error = answer[c + 3];
        // Four images tell their own error within a factor of two or so.
        const double noise = std::hypot(error, 2 * m.error());
        INFO("channel " << c << ": " << m.mean() << ", Mitsuba's " << expected << " ± " << noise);
        CHECK(std::abs(m.mean() - expected) <= 4 * noise + 2e-3 * expected);
      }
    }
  CHECK(count > 1700);
}
