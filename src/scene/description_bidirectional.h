// Integrators that trace sub-paths from the lights, as plain data.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scene/path_limits.h"

namespace duet {

/// Methods that trace sub-paths from the lights, too.
enum class BidirectionalMethod { ptracer, bdpt, reuse, ppm, bpm, vcm };
/// How `reuse` weights its techniques: exactly, or as the thesis does (docs/mis.md), in
/// either of two readings of it.
enum class ReuseWeights { exact, thesis_a, thesis_b };
struct BidirectionalIntegratorDescription {
  BidirectionalMethod method = BidirectionalMethod::bdpt;
  /// In segments; −1 is no limit, but max_eye_depth + max_light_depth + 1 with the thesis' weights.
  int max_depth = -1;
  int rr_depth = kUsualRrDepth;
  bool hide_emitters = false, strict_normals = false;
  LightSelection light_selection = LightSelection::automatic;
  double light_paths = 0;  ///< light sub-paths per pixel; 0: the default of the method
  /// Light vertices to which each eye vertex is connected; −1: all of one light sub-path.
  int connections = -1;
  bool light_image = true;     ///< bdpt: connect light vertices to the camera
  bool guide_emission = true;  ///< learn where light sub-paths should begin
  /// bdpt: so many pixels of a tile, other ones in every sample, use one another's second vertices;
  /// 1: each has its own alone.
  int pixel_group = 1;
  double radius = 0;  ///< of merging in the first iteration, world units; 0: from the pixels' size
  double alpha = 0;   ///< how fast the radius shrinks; 0: the method's default
  int max_eye_depth = 4, max_light_depth = 3;  ///< reuse
  ReuseWeights weights = ReuseWeights::exact;  ///< reuse
  double continue_probability = 1;             ///< reuse
  /// vcm: the parts of the image in which it merges (transport/merge_mask.h), as chosen by `auto`;
  /// empty: all of it.
  std::vector<uint8_t> merge_parts = {};

  static constexpr std::string_view kMethods[] = {"ptracer", "bdpt", "reuse", "ppm", "bpm", "vcm"};
  static constexpr std::string_view kWeights[] = {"exact", "thesis", "thesis"},
                                    kReadings[] = {"b", "a", "b"};
  bool is(BidirectionalMethod m) const { return method == m; }
  bool connects() const { return is(BidirectionalMethod::bdpt) || is(BidirectionalMethod::vcm); }
  bool merges() const { return method >= BidirectionalMethod::ppm; }

  /// What only `reuse` has.
  static constexpr auto reuse_fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using D = BidirectionalIntegratorDescription;
    constexpr auto reuses = [](const D& d) { return d.is(BidirectionalMethod::reuse); };
    return FieldList(
        field(&D::max_eye_depth, Parameter{"max_eye_depth", integer, kInitial,
                                           "longest eye sub-path in segments", not_negative})
            .when(reuses),
        field(&D::max_light_depth, Parameter{"max_light_depth", integer, kInitial,
                                             "longest light sub-path in segments", not_negative})
            .when(reuses),
        field(&D::weights, Parameter{"weights", string, kInitial,
                                     "exact, or those of the thesis, which are biased "
                                     "(docs/mis.md)"})
            .words(kWeights)
            .read_by_plugin()
            .when(reuses),
        field(&D::weights, Parameter{"thesis_reading", string, kInitial,
                                     "a or b, what the weights of the thesis are taken to mean"})
            .words(kReadings)
            .read_by_plugin()
            .when([](const D& d) {
              return d.is(BidirectionalMethod::reuse) && d.weights != ReuseWeights::exact;
            }),
        field(&D::continue_probability,
              Parameter{"continue_probability", number, kInitial,
                        "that an eye sub-path goes on beyond its limit", probability})
            .when(reuses));
  }
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using D = BidirectionalIntegratorDescription;
    using enum BidirectionalMethod;
    constexpr auto merging = [](const D& d) { return d.merges(); };
    return joined_fields(
        FieldList(
            field(&D::method), field(&D::max_depth, max_depth_parameter()),
            field(&D::rr_depth, kRrDepth), field(&D::hide_emitters, kHideEmitters),
            field(&D::strict_normals, kStrictNormals).when([](const D& d) {
              return !d.is(ptracer);
            }),
            field(&D::light_selection, kLightSelection)
                .words(kLightSelectionNames)
                .terse()
                .when([](const D& d) { return !d.is(ptracer); }),
            field(&D::light_paths,
                  Parameter{
                      "light_paths", number, kInitial,
                      "light sub-paths for each pixel; 0: 1/4 for bdpt and vcm, 1 for the others",
                      not_negative})
                .when([](const D& d) { return !d.is(ptracer) || d.light_paths != 0; }),
            field(&D::connections,
                  Parameter{"connections", integer, kInitial,
                            "light vertices for each eye vertex; -1: those of one light sub-path",
                            depth})
                .when([](const D& d) { return d.connects(); }),
            field(&D::light_image, Parameter{"light_image", boolean, kInitial,
                                             "connect light vertices to the camera"})
                .when([](const D& d) { return d.is(bdpt); }),
            field(&D::pixel_group, kPixelGroup).terse().when([](const D& d) { return d.is(bdpt); }),
            field(&D::guide_emission,
                  Parameter{"guide_emission", boolean, kInitial,
                            "learn at which light and with which rays light sub-paths begin best"})
                .terse(),
            field(&D::radius,
                  Parameter{.name = "radius",
                            .type = number,
                            .preset = kInitial,
                            .note = "of merging in the first iteration, in world units; 0: "
                                    "from the size of a pixel",
                            .range = not_negative,
                            .aliases = "initial_radius"})
                .when(merging),
            field(&D::alpha,
                  Parameter{"alpha", number, kInitial,
                            "how fast the radius shrinks; 0: the method's default", fraction})
                .when(merging),
            field(&D::merge_parts)),
        reuse_fields());
  }
  std::string_view method_name() const { return kMethods[size_t(method)]; }
  std::vector<std::string> losses() const {
    if (!is(BidirectionalMethod::ptracer))
      return {"only Duet reads the integrator \"" + std::string(method_name()) + "\""};
    if (light_paths == 0) return {};
    return {"only Duet reads \"light_paths\" of the integrator \"ptracer\""};
  }
};

}  // namespace duet
