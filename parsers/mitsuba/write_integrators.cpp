// The integrator of a written scene.
#include <array>

#include "mitsuba/scene_writer.h"

namespace duet {

void SceneWriter::integrator(const IntegratorDescription& i) {
  const bool layers = !i.aovs.layers.empty() || !i.image;
  if (layers) {
    std::string list;
    for (const AovDescription::Layer& l : i.aovs.layers)
      list += fmt::format("{}{}:{}", list.empty() ? "" : ", ", l.name, l.kind);
    out_.open("integrator", "aov");
    out_.string("aovs", list);
  }
  if (i.moments) out_.open("integrator", "moment");
  if (i.image) std::visit([this](const auto& method) { write_method(method); }, i.method);
  if (i.moments) out_.close();
  if (layers) out_.close();
}

void SceneWriter::write_limits(const PathLimits& m) {
  out_.integer("max_depth", m.max_depth);
  out_.integer("rr_depth", m.rr_depth);
  out_.boolean("hide_emitters", m.hide_emitters);
}

void SceneWriter::write_path(std::string_view type, const PathLimits& m) {
  out_.open("integrator", type);
  write_limits(m);
  if (m.strict_normals) lose("\"strict_normals\" does not exist in Mitsuba 3");
  out_.close();
}

void SceneWriter::write_method(const PathIntegratorDescription& m) {
  write_path("path", m);
}

void SceneWriter::write_method(const VolumePathIntegratorDescription& m) {
  write_path(m.name == VolumePathName::volpath ? "volpath" : "volpathmis", m);
}

void SceneWriter::write_method(const AutoIntegratorDescription& m) {
  lose("only Duet reads the integrator \"auto\"");
  out_.open("integrator", "auto");
  write_limits(m);
  out_.boolean("strict_normals", m.strict_normals);
  out_.close();
}

void SceneWriter::write_method(const DirectIntegratorDescription& m) {
  out_.open("integrator", "direct");
  out_.integer("emitter_samples", m.emitter_samples);
  out_.integer("bsdf_samples", m.bsdf_samples);
  out_.boolean("hide_emitters", m.hide_emitters);
  if (m.strict_normals) lose("\"strict_normals\" does not exist in Mitsuba 3");
  out_.close();
}

void SceneWriter::write_method(const DepthIntegratorDescription&) {
  out_.open("integrator", "depth");
  out_.close();
}

void SceneWriter::write_method(const OcclusionIntegratorDescription& m) {
  lose("Mitsuba 3 has no integrator \"ao\"");
  out_.open("integrator", "ao");
  out_.integer("shading_samples", m.shading_samples);
  out_.number("ray_length", m.ray_length);
  out_.close();
}

void SceneWriter::write_method(const BidirectionalIntegratorDescription& m) {
  using enum BidirectionalMethod;
  constexpr std::array<std::string_view, 6> names{"ptracer", "bdpt", "reuse", "ppm", "bpm", "vcm"};
  const std::string_view name = names[size_t(m.method)];
  out_.open("integrator", name);
  write_limits({m.max_depth, m.rr_depth, m.hide_emitters});
  if (m.method == ptracer) {
    if (m.light_paths != 0) {
      lose("only Duet reads \"light_paths\" of the integrator \"ptracer\"");
      out_.number("light_paths", m.light_paths);
    }
    out_.close();
    return;
  }
  lose(fmt::format("only Duet reads the integrator \"{}\"", name));
  out_.boolean("strict_normals", m.strict_normals);
  out_.number("light_paths", m.light_paths);
  if (m.method == bdpt || m.method == vcm) out_.integer("connections", m.connections);
  if (m.method == bdpt) out_.boolean("light_image", m.light_image);
  if (m.method == ppm || m.method == bpm || m.method == vcm) {
    out_.number("radius", m.radius);
    out_.number("alpha", m.alpha);
  }
  if (m.method == reuse) {
    out_.integer("max_eye_depth", m.max_eye_depth);
    out_.integer("max_light_depth", m.max_light_depth);
    out_.string("weights", m.weights == ReuseWeights::exact ? "exact" : "thesis");
    if (m.weights != ReuseWeights::exact)
      out_.string("thesis_reading", m.weights == ReuseWeights::thesis_a ? "a" : "b");
    out_.number("continue_probability", m.continue_probability);
  }
  out_.close();
}

}  // namespace duet
