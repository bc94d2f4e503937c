#include "pbrt/scene_writer.h"

#include "pbrt/writer.h"

namespace duet::pbrt {

void SceneWriter::write() {
  for (size_t i = 0; i < d_.media.size(); ++i) medium(i);
  const SensorDescription standard;
  const SensorDescription& s = d_.sensors.empty() ? standard : d_.sensors.front();
  if (d_.sensors.size() > 1) lose("of several sensors only the first is there");
  if (times_ != std::array<double, 2>{0, 1})
    head_text_ += fmt::format("TransformTimes {} {}\n", times_[0], times_[1]);
  camera(s);
  film(s, s.shutter[1] > s.shutter[0] ? s.shutter[1] - s.shutter[0] : 1);
  filter(s.film.filter);
  sampler(s.sampler);
  integrator();
  for (const LightDescription& l : d_.lights) light(l);
  for (size_t i = 0; i < d_.groups.size(); ++i) {
    group_names_.push_back(fmt::format("object{}", i));
    world_text_ += fmt::format("ObjectBegin {}\n", Statement::quoted(group_names_.back()));
    for (const ShapeDescription& shape : d_.groups[i].shapes) this->shape(shape, true);
    world_text_ += "ObjectEnd\n";
  }
  for (const ShapeDescription& shape : d_.shapes) this->shape(shape, false);
}

std::string SceneWriter::text() const {
  return media_text_ + head_text_ + "\nWorldBegin\n\n" + textures_text_ + "\n" + materials_text_ +
         "\n" + world_text_;
}

namespace {

/// The two times of all motion but that of lights, which pbrt does not have; nothing if there are
/// others, or more than two.
std::optional<std::array<double, 2>> times_of_motion(const SceneDescription& scene) {
  std::optional<std::array<double, 2>> times;
  bool fits = true;
  const auto look = [&](const Motion& motion) {
    if (motion.empty()) return;
    const auto& k = motion.keyframes();
    const std::array<double, 2> own{k.front().time, k.back().time};
    fits = fits && k.size() == 2 && own == times.value_or(own);
    times = own;
  };
  for_each_shape(scene, [&](const ShapeDescription& s) { look(s.motion); });
  for (const SensorDescription& s : scene.sensors) look(s.motion);
  if (!fits) return std::nullopt;
  return times.value_or(std::array<double, 2>{0, 1});
}

PbrtText write(const SceneDescription& description, const std::array<double, 2>& times,
               std::vector<std::string> losses) {
  SceneWriter writer(description, times);
  writer.write();
  losses.insert(losses.end(), writer.losses().begin(), writer.losses().end());
  std::string text = "# pbrt-v4\n";
  for (const std::string& loss : losses) text += "# Not in pbrt-v4: " + loss + "\n";
  for (const Diagnostic& a : description.approximations)
    text += "# Approximated: " + a.message + "\n";
  return {text + writer.text(), std::move(losses)};
}

}  // namespace

PbrtText write_pbrt(const SceneDescription& description) {
  if (const auto times = times_of_motion(description)) return write(description, *times, {});
  const double time = description.sensors.empty() ? 0 : description.sensors[0].shutter[0];
  return write(
      scene_at(description, time), {0, 1},
      {fmt::format("motion by more than two times: everything stands as it does at {}", time)});
}

}  // namespace duet::pbrt
