#include "mitsuba/plugins/bsdf.h"
#include "mitsuba/plugins/bsdfs.h"

namespace duet::plugins {

namespace {

void read_measured(SceneReader& s, Properties& p, MaterialDescription& out) {
  const std::string file = s.file(p, "filename");
  if (file.empty()) return;
  if (auto table =
          s.report().from_file(p.where("filename"), [&] { return s.files().read_measured(file); }))
    out.model = MeasuredMaterial{std::make_shared<MeasuredTable>(std::move(*table)), file};
}

}  // namespace

Plugin measured() {
  return bsdf<MeasuredMaterial>({.versions = v3, .reader = &read_measured, .note = "files in RGB"});
}

}  // namespace duet::plugins
