#include "app/scene_summary.h"

#include <filesystem>
#include <map>
#include <set>

#include "app/description_text.h"
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
        all_(all) {}

  std::string write() {
    out_ = scene_.file + "\n";
    list("parameters", loaded_.parameters,
         [](const auto& p) { return fmt::format("${} = {}", p.first, p.second); });
    integrator();
    for (size_t i = 0; i < scene_.sensors.size(); ++i) sensor(i);
    shapes();
    materials();
    list("textures", scene_.textures, [&](const auto& t) { return text_.texture(t); });
    media();
    lights();
    line("modelled", describe(features_));
    line("methods", describe(method_rules(features_)));
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

  /// Also those of the groups.
  template <class Visit>
  void for_each_shape(Visit visit) const {
    for (const ShapeDescription& s : scene_.shapes) visit(s);
    for (const ShapeGroupDescription& g : scene_.groups)
      for (const ShapeDescription& s : g.shapes) visit(s);
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
    std::map<std::string, size_t> kinds;
    for (const ShapeDescription& s : scene_.shapes) ++kinds[text_.shape_kind(s)];
    std::string summary;
    for (const auto& [kind, count] : kinds)
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

  /// Those that surfaces name; what is nested in them is part of their text.
  void materials() {
    std::set<MaterialId> used;
    for_each_shape([&](const ShapeDescription& s) {
      if (!std::holds_alternative<InstanceShape>(s.geometry)) used.insert(s.material);
    });
    list("bsdfs", used,
         [&](MaterialId id) { return fmt::format("{}: {}", text_.name(id), text_.material(id)); });
  }

  void media() {
    std::set<MediumId> used;
    const auto use = [&](std::optional<MediumId> id) {
      if (id) used.insert(*id);
    };
    for_each_shape([&](const ShapeDescription& s) { use(s.interior), use(s.exterior); });
    for (const SensorDescription& s : scene_.sensors) use(s.medium);
    list("media", used, [&](MediumId id) {
      return fmt::format("{}: {}", text_.name(id), text_.medium(scene_.media[size_t(id)]));
    });
  }

  void lights() {
    std::vector<std::string> all;
    for_each_shape([&](const ShapeDescription& s) {
      if (s.emission) all.push_back(text_.area_light(s));
    });
    for (const LightDescription& l : scene_.lights) all.push_back(text_.light(l));
    if (all.empty()) line("lights", "none");
    list("lights", all, [](const std::string& text) { return text; });
  }

  const LoadedScene& loaded_;
  const SceneDescription& scene_;
  const SceneFeatures features_;
  DescriptionText text_;
  bool all_;
  std::string out_;
};

}  // namespace

std::string scene_summary(const LoadedScene& scene, bool all) {
  return Summary(scene, all).write();
}

}  // namespace duet
