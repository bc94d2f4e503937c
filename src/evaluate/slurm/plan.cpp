#include "evaluate/slurm/plan.h"

#include <fmt/format.h>

#include <set>

#include "base/failures.h"
#include "evaluate/render/file_settings_text.h"
#include "evaluate/render/file_uses.h"
#include "evaluate/render/output.h"
#include "evaluate/render/scene_method.h"
#include "evaluate/render/scene_operand.h"

namespace duet::slurm {

namespace {

ImageJob job_of(const ArrayRequest& request, const std::string& file, const OutputNames& names,
                uint32_t spp) {
  ImageJob job;
  job.program = request.program;
  job.scene = file;
  job.spp = spp, job.tasks = request.tasks;
  job.render_options = request.render_options;
  job.has_threads = request.has_threads;
  // As the scene says it now: all tasks have to mean the same slices.
  if (!request.render.budget.spp)
    job.render_options.insert(job.render_options.end(), {"--spp", names.spp});
  std::vector<std::string> patterns = request.outputs;
  if (patterns.empty()) patterns.emplace_back();
  FileUses uses;
  uses.read("the scene", file);
  for (const std::string& pattern : patterns) {
    const std::string path = output_path(pattern, names);
    uses.write("-o", path);
    job.merge_options.insert(job.merge_options.end(), {"-o", path});
  }
  for (const std::string& argument : file_arguments(request.render.files))
    job.merge_options.push_back(argument);
  name_job(job, job.merge_options[1]);
  job.sbatch_options = request.sbatch_options;
  return job;
}

}  // namespace

ImageJob plan_job(const std::string& file, const ArrayRequest& request, Messages& messages) {
  if (file == kStandardInput) throw UsageError("-: tasks have no standard input");
  const RenderOptions& options = request.render;
  SceneDescription scene = load_scene(file, options.read, messages).description;
  const SensorDescription& sensor = chosen_sensor(scene, options.sensor, file);
  // What every task would find out.
  chosen_method(scene, sensor, options, messages);
  const int spp = options.budget.spp.value_or(sensor.sampler.sample_count);
  if (int64_t(request.tasks) > spp)
    throw UsageError(
        fmt::format("--tasks {}: {} is rendered with {} samples per pixel, which have no {} parts",
                    request.tasks, file, spp, request.tasks));
  OutputNames names = output_names(file);
  names.integrator = integrator_name(scene.integrator);
  names.spp = fmt::to_string(spp);
  names.seed = fmt::to_string(options.seed.value_or(sensor.sampler.seed));
  return job_of(request, file, names, uint32_t(spp));
}

void check_folders_differ(const std::vector<ImageJob>& jobs) {
  std::set<std::string> folders;
  for (const ImageJob& job : jobs)
    if (!folders.insert(job.folder).second)
      throw UsageError(fmt::format("-o: two images have the folder {}", job.folder));
}

}  // namespace duet::slurm
