// Defaults stand once: the tables take them from the values with which members begin.
#include <doctest/doctest.h>

#include "scene/description.h"
#include "scene/field_parameters.h"

using namespace duet;

namespace {

enum class Tone { low, high };

struct Bell {
  Tone tone = Tone::high;
  double size = 2.5;
  int strokes = 3;
  bool cracked = true;
  ColorInput color = Spectrum(0.75f);
  std::optional<double> weight;
  std::string maker = "unknown";

  static constexpr std::string_view kTones[] = {"low", "high"};
  static constexpr auto fields() {
    using enum ParameterType;
    return FieldList(field(&Bell::tone, Parameter{"tone", string, kInitial}).words(kTones),
                     field(&Bell::size, Parameter{"size", number, kInitial}).terse(),
                     field(&Bell::strokes, Parameter{"strokes", integer, kInitial},
                           Parameter{"repeats", integer, "(strokes)"}),
                     field(&Bell::cracked, Parameter{"cracked", boolean, kInitial}),
                     field(&Bell::color, Parameter{"color", reflectance, kInitial}),
                     field(&Bell::weight, Parameter{"weight", number, kInitial}),
                     field(&Bell::maker, Parameter{"maker", string, kInitial}));
  }
};

}  // namespace

TEST_CASE("fields: defaults are the initial values of members, as text") {
  CHECK(parameter<Bell>("tone").preset == "high");
  CHECK(parameter<Bell>("size").preset == "2.5");
  CHECK(parameter<Bell>("strokes").preset == "3");
  CHECK(parameter<Bell>("repeats").preset == "(strokes)");
  CHECK(parameter<Bell>("cracked").preset == "true");
  CHECK(parameter<Bell>("color").preset == "0.75");
  CHECK(parameter<Bell>("weight").preset == "");
  CHECK(parameter<Bell>("maker").preset == "unknown");
}

TEST_CASE("fields: parameters are found by name, in the order that is asked for") {
  CHECK(parameters_of<Bell>().size() == 8);
  const std::vector<Parameter> some = parameters_of<Bell>("maker size");
  REQUIRE(some.size() == 2);
  CHECK(some[0].name == "maker");
  CHECK(some[1].name == "size");
  CHECK(parameters_of<Bell>("").empty());
  CHECK_THROWS_AS(parameters_of<Bell>("maker sise"), std::out_of_range);
}

TEST_CASE("fields: a terse field knows whether it has its initial value") {
  const auto is_initial = [](const Bell& bell) {
    bool initial = false;
    for_each_field(bell, [&](const FieldFacts& facts, const auto&) {
      if (facts.name() == "size") initial = facts.initial;
    });
    return initial;
  };
  Bell bell;
  CHECK(is_initial(bell));
  bell.size = 3;
  CHECK(!is_initial(bell));
}
