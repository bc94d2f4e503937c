#include "evaluate/report/header.h"

#include <cmath>

#include "evaluate/report/provenance.h"
#include "image/cryptomatte.h"
#include "math/angles.h"

namespace duet {

namespace {

/// For row vectors, as OpenEXR stores matrices: the transpose.
std::array<float, 16> exr_matrix(const Matrix4& m) {
  std::array<float, 16> out;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) out[size_t(4 * i + j)] = float(m[j][i]);
  return out;
}

/// From camera space (x to the right, y up) to normalised device coordinates: the image is the unit
/// square, y downwards, after division by w.
Matrix4 camera_to_ndc(const SensorDescription& view, Point2i size) {
  const double aspect = double(size.x) / size.y;
  Matrix4 m;
  if (view.kind == SensorKind::orthographic || view.kind == SensorKind::telecentric) {
    // The film is two units wide.
    m[0] = {0.5, 0, 0, 0.5};
    m[1] = {0, -0.5 * aspect, 0, 0.5};
    return m;
  }
  const double fov = horizontal_fov(view.fov, view.fov_axis, aspect);
  const double t = std::tan(0.5 * fov * kRadians);
  m[0] = {0.5 / t, 0, 0.5 - view.principal_point_offset_x, 0};
  m[1] = {0, -0.5 * aspect / t, 0.5 - view.principal_point_offset_y, 0};
  m[2] = {0, 0, 1, 0};
  m[3] = {0, 0, 1, 0};
  return m;
}

}  // namespace

HeaderFields scene_header(const RenderRecord& record, const SensorDescription& view,
                          Point2i full_size) {
  HeaderFields fields{
      {"program", "Duet"},
      {"version", DUET_VERSION},
      {"scene", host_free(record.scene_file)},
      {"sceneHash", record.scene_hash},
      {"integrator", record.integrator},
      {"integratorParameters", record.integrator_parameters},
      {"sampler", record.sampler},
      {"seed", fmt::to_string(record.seed)},
  };
  if (record.decision) {
    fields.emplace_back("chosenIntegrator", record.decision->method);
    fields.emplace_back("chosenParameters", record.decision->parameters);
    fields.emplace_back("choiceReason", record.decision->reason);
  }
  if (!record.bias.empty()) fields.emplace_back("bias", record.bias);
  if (const auto world_to_camera = view.to_world.inverse()) {
    const Matrix4 camera = Matrix4::scale(-1, 1, 1) * *world_to_camera;
    fields.emplace_back("worldToCamera", exr_matrix(camera));
    if (has_fov(view.kind) || view.kind == SensorKind::orthographic ||
        view.kind == SensorKind::telecentric)
      fields.emplace_back("worldToNDC", exr_matrix(camera_to_ndc(view, full_size) * camera));
  }
  return fields;
}

HeaderFields samples_header(const RenderRecord& record, const RenderResult& result) {
  HeaderFields fields{
      {"commandLine", record.command_line},
      {"date", image_date()},
      {"spp", result.spp},
      {"lightSubpaths", fmt::to_string(result.counters.light_paths)},
      {"threads", record.threads},
  };
  if (!is_reproducible()) fields.emplace_back("renderSeconds", float(result.seconds));
  if (result.interrupted) fields.emplace_back("interrupted", 1);
  const RenderBudget& requested = record.requested;
  if (requested.spp) fields.emplace_back("requestedSpp", *requested.spp);
  if (requested.seconds) fields.emplace_back("requestedSeconds", float(*requested.seconds));
  if (requested.target_error) fields.emplace_back("requestedError", float(*requested.target_error));
  if (result.relative_rmse) {
    fields.emplace_back("relativeStandardError", float(*result.relative_rmse));
    fields.emplace_back("relativeRmseEstimate", float(*result.relative_rmse));  // its older name
    fields.emplace_back("relativeRmseIsUpperBound", int(result.rmse_is_upper_bound));
    fields.emplace_back("relativeRmseIsNoiseOnly", int(record.noise_only));
  }
  return fields;
}

TextFields header_texts(const HeaderFields& fields) {
  struct Text {
    std::string operator()(const std::string& v) const { return v; }
    std::string operator()(float v) const { return fmt::to_string(v); }
    std::string operator()(int v) const { return fmt::to_string(v); }
    std::string operator()(const std::array<float, 16>&) const { return ""; }
  };
  TextFields texts;
  for (const auto& [name, value] : fields)
    if (std::string text = std::visit(Text{}, value);
        !text.empty() && !name.starts_with(kMatteFields))
      texts.emplace_back(name, std::move(text));
  return texts;
}

}  // namespace duet
