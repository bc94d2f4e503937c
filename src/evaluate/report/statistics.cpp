#include "evaluate/report/statistics.h"

#include <nlohmann/json.hpp>

#include "base/system/atomic_file.h"
#include "base/system/memory.h"
#include "evaluate/report/scene_json.h"

namespace duet {

SceneCounts count_parts(const Scene& scene) {
  SceneCounts n;
  n.emitters = scene.lights.size();
  n.instances = scene.instances.size();
  for (const Shape& s : scene.shapes) n.triangles += s.mesh ? s.mesh->triangles.size() : 0;
  return n;
}

bool target_met(const RenderRecord& record, const RenderResult& result) {
  const std::optional<double>& target = record.requested.target_error;
  return target && result.relative_rmse && *result.relative_rmse <= *target;
}

void StatisticsFile::add(const RenderRecord& record, const RenderResult& result,
                         const PhaseSeconds& seconds, const SceneCounts& counts) {
  const RenderCounters& c = result.counters;
  nlohmann::ordered_json j;
  j["scene"] = record.scene_file;
  j["integrator"] = record.integrator;
  if (record.decision)
    j["chosen"] = {{"integrator", record.decision->method},
                   {"parameters", record.decision->parameters},
                   {"reason", record.decision->reason}};
  if (!record.bias.empty()) j["bias"] = record.bias;
  j["spp"] = result.spp;
  j["seed"] = record.seed;
  j["threads"] = record.threads;
  j["seconds"] = {{"parse", seconds.parse},
                  {"build", seconds.build},
                  {"render", seconds.render},
                  {"write", seconds.write}};
  j["memory_peak_bytes"] = uint64_t(memory_peak());
  j["rays"] = {{"closest", c.closest_rays}, {"shadow", c.shadow_rays}};
  j["medium_steps"] = c.medium_steps;
  j["paths"] = {{"camera", c.camera_paths}, {"light", c.light_paths}};
  j["mean_path_length"] =
      c.camera_paths > 0 ? double(c.path_vertices) / double(c.camera_paths) : 0.0;
  const ConnectionCounters& connections = c.connections;
  j["connections"] = {{"attempted", connections.attempted()},
                      {"contributed", connections.contributed},
                      {"failed_specular", connections.failed_specular},
                      {"failed_occluded", connections.failed_occluded},
                      {"failed_zero", connections.failed_zero},
                      {"skipped", connections.skipped}};
  j["merges"] = {{"queried", c.merge_queries}, {"accepted", c.merges}};
  j["eye_subpaths_at_limit"] = c.eye_subpaths_at_limit;
  j["reused_subpaths"] = c.reused_subpaths;
  j["nonfinite_samples"] = c.nonfinite_samples;
  const nlohmann::ordered_json error =
      result.relative_rmse ? nlohmann::ordered_json(*result.relative_rmse) : nullptr;
  j["error"]["relative_standard_error"] = error;
  j["error"]["relative_rmse_estimate"] = error;  // its older name
  j["error"]["is_upper_bound"] = result.rmse_is_upper_bound;
  j["error"]["noise_only"] = record.noise_only;
  if (record.requested.target_error) {
    j["error"]["target"] = *record.requested.target_error;
    j["error"]["target_met"] = target_met(record, result);
  }
  j["emitters"] = counts.emitters;
  j["triangles"] = counts.triangles;
  j["instances"] = counts.instances;
  j["interrupted"] = result.interrupted;
  entries_.push_back(json_text(j));
}

void StatisticsFile::add_failure(const std::string& scene, const std::vector<std::string>& messages,
                                 bool interrupted) {
  nlohmann::ordered_json j;
  j["scene"] = scene;
  j["failed"] = true;
  j["messages"] = messages;
  j["interrupted"] = interrupted;
  entries_.push_back(json_text(j));
}

void StatisticsFile::write(bool several) const {
  if (entries_.empty() && !several) return;
  std::string text = several ? "[\n" : "";
  for (size_t i = 0; i < entries_.size(); ++i) text += (i > 0 ? ",\n" : "") + entries_[i];
  text += several ? "\n]\n" : "\n";
  write_file_atomically(path_, text);
}

}  // namespace duet
