// An integrator in whose place another method is run: it may be unknown, and nothing is said of it.
#include <doctest/doctest.h>

#include "support/memory_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

ReadResult replaced(const std::string& integrator, const std::vector<std::string>& methods,
                    const std::string& version = "3.0.0") {
  MitsubaOptions options;
  options.replacing_methods = methods;
  return read_with(options, "<scene version='" + version + "'><sensor type='perspective'/>" +
                                integrator + "</scene>");
}

const PathIntegratorDescription* path(const ReadResult& r) {
  return r.scene ? std::get_if<PathIntegratorDescription>(&r.description().integrator.method)
                 : nullptr;
}

const std::string kUnknown =
    "<integrator type='path_sms_ss'><integer name='max_depth' value='6'/>"
    "<boolean name='hide_emitters' value='true'/><float name='threshold' value='$undefined'/>"
    "<integer name='rr_depth' value='often'/><ref id='nothing'/><odd/></integrator>";

}  // namespace

TEST_CASE("an unknown integrator is an error that tells the way out") {
  const ReadResult r = replaced("<integrator type='guided_path'/>", {}, "0.6.0");
  CHECK(!r.scene);
  CHECK(r.has("error: unknown integrator type \"guided_path\"; -i METHOD renders the scene"));
  CHECK(replaced("<integrator type='volprim_rf_basic'/>", {}).has("; -i METHOD renders"));
  CHECK(!read_scene("3.0.0", "<bsdf type='odd'/>").has("-i METHOD"));
}

TEST_CASE("another method takes the place of an unknown integrator, with a warning") {
  const ReadResult r = replaced(kUnknown, {"bdpt"});
  CHECK(r.messages() ==
        "/scene/scene.xml:1:64: warning: the integrator \"path_sms_ss\" is unknown: bdpt takes its "
        "place\n");
  // What all methods share is kept where it can be read.
  REQUIRE(path(r));
  CHECK(*path(r) == PathIntegratorDescription{{6, 2, true, false}});
  CHECK(replaced("<integrator type='volprim_rf_basic'/>", {"path"}).scene);
  // Elsewhere in the scene errors are errors.
  CHECK(!replaced(kUnknown + "<shape type='sphere'><ref id='nothing'/></shape>", {"path"}).scene);
}

TEST_CASE("the parameters of a replaced integrator are not checked") {
  const std::string wrong =
      "<integrator type='direct'><integer name='bsdf_samples' value='-3'/>"
      "<string name='hide_emitters' value='?'/><float name='odd' value='1'/></integrator>";
  CHECK(!replaced(wrong, {}).scene);
  CHECK(!replaced(wrong, {"direct"}).scene);
  CHECK(!replaced(wrong, {"path", "direct"}).scene);
  const ReadResult r = replaced(wrong, {"path", "bdpt"});
  CHECK(r.scene);
  CHECK(r.messages() == "");
}

TEST_CASE("of what is replaced nothing is approximated") {
  const std::string mlt = "<integrator type='mlt'><float name='pLarge' value='1'/></integrator>";
  CHECK(replaced(mlt, {}, "0.6.0").description().approximations.size() == 2);
  const ReadResult r = replaced(mlt, {"path"}, "0.6.0");
  REQUIRE(r.scene);
  // The scene has no light, of either.
  CHECK(r.description().approximations.size() == 1);
  CHECK(!r.has("mlt"));
  const ReadResult none = replaced("", {"path"});
  CHECK(none.messages() == "");
  CHECK(replaced("", {}).has("the scene has no integrator"));
}

TEST_CASE("layers stay, and what makes them is checked") {
  const auto layers = [](const std::string& list) {
    return "<integrator type='aov'><string name='aovs' value='" + list + "'/>" + kUnknown +
           "</integrator>";
  };
  const ReadResult r = replaced(layers("d:depth"), {"vcm"});
  REQUIRE(r.scene);
  CHECK(r.description().integrator.aovs.layers.size() == 1);
  CHECK(path(r)->max_depth == 6);
  CHECK(replaced(layers("d:deep"), {"vcm"}).has("unknown kind of layer"));
  // A method that holds the one that is run is not replaced.
  const std::string adaptive =
      "<integrator type='adaptive'><integrator type='path'><integer name='maxDepth' value='x'/>"
      "</integrator></integrator>";
  CHECK(!replaced(adaptive, {"path"}, "0.6.0").scene);
  CHECK(replaced(adaptive, {"bdpt"}, "0.6.0").scene);
}
