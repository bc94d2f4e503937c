#include "pbrt/pbrt.h"

#include "pbrt/reader.h"

namespace duet::pbrt {

bool is_pbrt_file(std::string_view file) {
  return file.ends_with(".pbrt") || file.ends_with(".pbrt.gz");
}

std::optional<PbrtScene> read_pbrt(const std::string& file, const Options& options,
                                   Diagnostics& diagnostics) {
  Report report(diagnostics);
  const SourceLocation start{std::make_shared<const std::string>(file), 0, 0};
  PbrtScene scene;
  // Tells the caller that the file is read.
  if (options.exists) options.exists(file);
  try {
    scene.version = options.version ? *options.version : find_version(file, options);
    Reader reader(file, options, scene.version, report);
    reader.read();
    scene.description = reader.take();
  } catch (const ReadError& e) {
    report.error(start, "{}", e.what());
  } catch (const std::bad_alloc&) {
    report.error(start, "the scene is too large for the memory");
  }
  report.finish(start);
  if (report.has_errors()) return std::nullopt;
  return scene;
}

}  // namespace duet::pbrt
