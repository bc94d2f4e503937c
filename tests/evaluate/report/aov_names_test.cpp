#include "evaluate/report/aov_names.h"

#include <doctest/doctest.h>

#include <stdexcept>

#include "integrators/layers.h"

using namespace duet;

namespace {

using Names = std::vector<std::string>;

/// The channels of colours and of a layer that is called `name`.
Names with_layer(const std::string& name) {
  Names channels{"R", "G", "B", "A"};
  for (const std::string& c : layer_channels({find_layer(name).value(), name}))
    channels.push_back(c);
  return channels;
}

Names named_layer(AovNames names, const std::string& name) {
  const Names all = channels_in(names, with_layer(name));
  return {all.begin() + 4, all.end()};
}

}  // namespace

TEST_CASE("layers have the names that other programs give them") {
  struct Row {
    const char* layer;
    Names blender, nuke, mitsuba;
  };
  const Row rows[] = {
      {"depth", {"ViewLayer.Depth.Z"}, {"depth.Z"}, {"depth.T"}},
      {"albedo",
       {"ViewLayer.DiffCol.R", "ViewLayer.DiffCol.G", "ViewLayer.DiffCol.B"},
       {"albedo.red", "albedo.green", "albedo.blue"},
       {"albedo.R", "albedo.G", "albedo.B"}},
      {"normal",
       {"ViewLayer.Normal.X", "ViewLayer.Normal.Y", "ViewLayer.Normal.Z"},
       {"N.red", "N.green", "N.blue"},
       {"sh_normal.X", "sh_normal.Y", "sh_normal.Z"}},
      {"position",
       {"ViewLayer.Position.X", "ViewLayer.Position.Y", "ViewLayer.Position.Z"},
       {"P.red", "P.green", "P.blue"},
       {"position.X", "position.Y", "position.Z"}},
      {"uv", {"ViewLayer.UV.U", "ViewLayer.UV.V"}, {"uv.red", "uv.green"}, {"uv.U", "uv.V"}},
      {"shape", {"ViewLayer.IndexOB.X"}, {"shape.red"}, {"shape_index.I"}},
      {"samples", {"ViewLayer.Debug Sample Count.X"}, {"samples.red"}, {"samples.I"}},
      {"denoise_split",
       {"ViewLayer.denoise_split.R", "ViewLayer.denoise_split.G", "ViewLayer.denoise_split.B",
        "ViewLayer.denoise_split.S"},
       {"denoise_split.red", "denoise_split.green", "denoise_split.blue", "denoise_split.alpha"},
       {"denoise_split.R", "denoise_split.G", "denoise_split.B", "denoise_split.S"}},
  };
  for (const Row& row : rows) {
    CAPTURE(row.layer);
    CHECK(channels_in(AovNames::duet, with_layer(row.layer)) == with_layer(row.layer));
    CHECK(named_layer(AovNames::blender, row.layer) == row.blender);
    CHECK(named_layer(AovNames::nuke, row.layer) == row.nuke);
    CHECK(named_layer(AovNames::mitsuba, row.layer) == row.mitsuba);
  }
  const Names colours{"R", "G", "B", "A"};
  CHECK(channels_in(AovNames::nuke, colours) == colours);
  CHECK(channels_in(AovNames::mitsuba, colours) == colours);
  CHECK(channels_in(AovNames::blender, colours) ==
        Names{"ViewLayer.Combined.R", "ViewLayer.Combined.G", "ViewLayer.Combined.B",
              "ViewLayer.Combined.A"});
}

TEST_CASE("every layer of --aov has a name that no other has, but for synonyms") {
  for (const AovNames names : {AovNames::blender, AovNames::nuke, AovNames::mitsuba}) {
    Names all{"R", "G", "B", "A"};
    for (const std::string& name : layer_names())
      if (name != "sh_normal" && name != "shape_index")
        for (const std::string& c : layer_channels({*find_layer(name), name})) all.push_back(c);
    CHECK(channels_in(names, all).size() == all.size());
  }
}

TEST_CASE("names that a scene gives stay, as far as the program can read them") {
  const Names own{"dd.y.T", "2nd layer.X", "2nd layer.Y"};
  CHECK(channels_in(AovNames::blender, own) ==
        Names{"ViewLayer.dd_y.Z", "ViewLayer.2nd layer.X", "ViewLayer.2nd layer.Y"});
  CHECK(channels_in(AovNames::nuke, own) ==
        Names{"dd_y.red", "_2nd_layer.red", "_2nd_layer.green"});
  CHECK(channels_in(AovNames::mitsuba, own) == own);
}

TEST_CASE("two layers of one name are refused") {
  CHECK_THROWS_WITH_AS(
      channels_in(AovNames::mitsuba, {"normal.X", "sh_normal.X"}),
      "with the names of mitsuba, normal.X and sh_normal.X are both called sh_normal.X",
      std::invalid_argument);
  CHECK_THROWS_AS(channels_in(AovNames::blender, {"a.b.X", "a_b.X"}), std::invalid_argument);
}

TEST_CASE("the colours of Blender's files are found") {
  Names names{"ViewLayer.Combined.R", "ViewLayer.Combined.A", "ViewLayer.Depth.Z"};
  take_combined_as_colours(names);
  CHECK(names == Names{"R", "A", "ViewLayer.Depth.Z"});
  // Those of the first layer; none where there are others.
  names = {"Fore.Combined.R", "Back.Combined.R"};
  take_combined_as_colours(names);
  CHECK(names == Names{"R", "Back.Combined.R"});
  names = {"R", "ViewLayer.Combined.R"};
  take_combined_as_colours(names);
  CHECK(names == Names{"R", "ViewLayer.Combined.R"});
}
