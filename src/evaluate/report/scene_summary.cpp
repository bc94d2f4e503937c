#include "evaluate/report/scene_summary.h"

#include "evaluate/report/description_text.h"
#include "evaluate/report/scene_memory.h"
#include "evaluate/report/scene_parts.h"
#include "integrators/make_integrator.h"
#include "integrators/method_rules.h"
#include "scene/features.h"
#include "scene/mitsuba_differences.h"

namespace duet {

namespace {

constexpr size_t kLongestList = 12;

class Summary {
 public:
  Summary(const LoadedScene& loaded, bool all)
      : loaded_(loaded),
        scene_(loaded.description),
        features_(scene_features(loaded.description)),
        text_(loaded.description),
        parts_(scene_parts(loaded.description)),
        all_(all) {}

  std::string write() {
    out_ = scene_.file + "\n";
    list("parameters", loaded_.parameters,
         [](const auto& p) { return fmt::format("${} = {}", p.first, p.second); });
    integrator();
    for (size_t i = 0; i < scene_.sensors.size(); ++i) sensor(i);
    shapes();
    named("bsdfs", parts_.bsdfs);
    list("textures", scene_.textures, [&](const auto& t) { return text_.texture(t); });
    named("media", parts_.media);
    lights();
    line("modelled", describe(features_));
    line("methods", describe(method_rules(features_)));
    line("memory", describe(estimate_scene_memory(scene_)));
    if (scene_.approximations.empty()) line("approximated", "nothing");
    list("approximated", scene_.approximations,
         [](const Diagnostic& a) { return fmt::format("{}: {}", a.where.to_string(), a.message); });
    list(
        "differs from Mitsuba", mitsuba_differences(scene_, features_),
        [](const MitsubaDifference* d) { return fmt::format("{}: {}", d->id, d->mitsuba); },
        "by how much is in docs/compatibility.md");
    return std::move(out_);
  }

 private:
  void line(const std::string& name, const std::string& text) {
    out_ += fmt::format("  {:13} {}\n", name, text);
  }
  /// A line for the list and one for each entry.
  template <class Things, class Describe>
  void list(const std::string& name, const Things& things, Describe describe_one,
            const std::string& summary = "") {
    if (things.empty()) return;
    line(name, fmt::format("{}{}{}", things.size(), summary.empty() ? "" : ": ", summary));
    size_t shown = 0;
    for (const auto& thing : things) {
      if (!all_ && shown == kLongestList) {
        out_ += fmt::format("    and {} more (-v lists all)\n", things.size() - shown);
        break;
      }
      out_ += "    " + describe_one(thing) + "\n";
      ++shown;
    }
  }

  void integrator() {
    const IntegratorDescription& i = scene_.integrator;
    const std::string parameters = integrator_parameters(i);
    line("integrator", integrator_name(i) + (parameters.empty() ? "" : ": " + parameters));
    list("layers", i.aovs.layers,
         [](const AovDescription::Layer& l) { return fmt::format("{}: {}", l.name, l.kind); });
    if (i.moments) line("moments", "of the colours, as layer m2");
  }

  void sensor(size_t i) {
    const SensorDescription& s = scene_.sensors[i];
    line(fmt::format("sensor {}", i), text_.sensor(s));
    line("  film", text_.film(s.film));
    line("  sampler", fmt::format("{}, {} samples per pixel, seed {}", s.sampler.name,
                                  s.sampler.sample_count, s.sampler.seed));
  }

  void shapes() {
    const SceneFeatures& f = features_;
    std::string summary;
    for (const auto& [kind, count] : parts_.shape_kinds)
      summary += fmt::format("{}{} {}", summary.empty() ? "" : ", ", count, kind);
    summary += fmt::format("; {} triangles", f.triangles);
    if (f.instances > 0) summary += fmt::format(" ({:.0f} in all copies)", f.placed_triangles);
    if (!f.bounds.empty())
      summary += fmt::format("; from ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g})", f.bounds.lower.x,
                             f.bounds.lower.y, f.bounds.lower.z, f.bounds.upper.x, f.bounds.upper.y,
                             f.bounds.upper.z);
    list(
        "shapes", scene_.shapes, [&](const auto& s) { return text_.shape(s); }, summary);
    for (const ShapeGroupDescription& g : scene_.groups)
      list(
          "shape group", g.shapes, [&](const auto& s) { return text_.shape(s); }, g.label.text);
  }

  void named(const std::string& name, const std::vector<NamedText>& things) {
    list(name, things, [](const NamedText& t) { return fmt::format("{}: {}", t.name, t.text); });
  }

  void lights() {
    if (parts_.lights.empty()) line("lights", "none");
    list("lights", parts_.lights, [](const std::string& text) { return text; });
  }

  const LoadedScene& loaded_;
  const SceneDescription& scene_;
  const SceneFeatures features_;
  const DescriptionText text_;
  const SceneParts parts_;
  bool all_;
  std::string out_;
};

}  // namespace

std::string scene_summary(const LoadedScene& scene, bool all) {
  return Summary(scene, all).write();
}

}  // namespace duet
