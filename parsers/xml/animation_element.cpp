// <animation>: transforms with the times at which they hold.
#include <algorithm>

#include "values/text.h"
#include "xml/value_elements.h"

namespace duet {

namespace {

struct PlacedKeyframe {
  Keyframe keyframe;
  SourceLocation where;
};

bool mirrors(const Matrix4& pose) {
  return pose.determinant3() < 0;
}

/// <transform time="…"> in an animation; nothing after an error.
std::optional<PlacedKeyframe> read_keyframe(const ElementContext& c, pugi::xml_node element) {
  if (std::string_view(element.name()) != "transform") {
    c.report.error(c.xml.where(element), "<{}> cannot stand in an <animation>, only <transform>",
                   element.name());
    return std::nullopt;
  }
  const Attributes a(c.xml, element, c.substitution, c.report);
  const bool named = a.check({"!time"});
  const auto time = named ? parse_number(a["time"]) : std::nullopt;
  if (named && !time)
    c.report.error(a.where("time"), "{} is not a finite number", in_quotes(a["time"]));
  const PropertyValue value = read_transform(c, element);
  const Matrix4* pose = std::get_if<Matrix4>(&value);
  if (!time || !pose) return std::nullopt;
  return PlacedKeyframe{{*time, *pose}, a.where()};
}

}  // namespace

PropertyValue read_animation(const ElementContext& c, pugi::xml_node element) {
  const SourceLocation where = c.xml.where(element);
  if (!c.version.is_0x()) {
    c.report.error(where, "<animation> only exists in Mitsuba 0.x, where things move");
    return Broken{};
  }
  std::vector<PlacedKeyframe> placed;
  bool good = true;
  for (pugi::xml_node child : element.children()) {
    if (child.type() != pugi::node_element) continue;
    if (auto keyframe = read_keyframe(c, child))
      placed.push_back(std::move(*keyframe));
    else
      good = false;
  }
  if (!good) return Broken{};
  if (placed.empty()) {
    c.report.error(where, "<animation> needs a <transform> with a time");
    return Broken{};
  }
  // In any order, as in Mitsuba 0.6.
  std::stable_sort(placed.begin(), placed.end(),
                   [](const auto& a, const auto& b) { return a.keyframe.time < b.keyframe.time; });
  std::vector<Keyframe> keyframes;
  for (const auto& [keyframe, place] : placed) {
    if (!keyframes.empty() && keyframes.back().time == keyframe.time) {
      c.report.error(place, "the <animation> has two transforms for the time {}", keyframe.time);
      return Broken{};
    }
    if (!keyframes.empty() && mirrors(keyframes.back().pose) != mirrors(keyframe.pose)) {
      c.report.error(place, "between the times {} and {} the <animation> turns space inside out",
                     keyframes.back().time, keyframe.time);
      return Broken{};
    }
    keyframes.push_back(keyframe);
  }
  if (std::all_of(keyframes.begin(), keyframes.end(),
                  [&](const Keyframe& k) { return k.pose == keyframes[0].pose; }))
    return keyframes[0].pose;
  return Motion(std::move(keyframes));
}

}  // namespace duet
