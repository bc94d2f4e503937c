#include "mitsuba/plugins/bsdf.h"
#include "mitsuba/plugins/bsdfs.h"

namespace duet::plugins {

namespace {

void read_measured(SceneReader& s, Properties& p, MaterialDescription& out) {
  const std::string file = s.file(p, "filename");
  if (file.empty()) return;
  try {
    out.model =
        MeasuredMaterial{std::make_shared<MeasuredTable>(s.files().read_measured(file)), file};
  } catch (const ReadError& error) {
    s.report().error(p.where("filename"), "{}", error.what());
  }
}

}  // namespace

Plugin measured() {
  return bsdf<MeasuredMaterial>({.versions = v3, .reader = &read_measured, .note = "files in RGB"});
}

Plugin measured_polarized() {
  return {.name = "measured_polarized",
          .versions = v3,
          .note = "light has no polarisation here",
          .support = refused,
          .refused_parameters = "filename alpha_sample wavelength"};
}

}  // namespace duet::plugins
