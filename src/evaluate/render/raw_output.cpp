#include "evaluate/render/raw_output.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "base/diagnostics.h"
#include "base/failures.h"
#include "base/system/standard_streams.h"

namespace duet {

namespace {

/// "folder/image.checkpoint.exr" for "folder/image.png".
std::string checkpoint_path(const std::string& image) {
  return std::filesystem::path(image).replace_extension(".checkpoint.exr").string();
}

/// "image.checkpoint.old.exr" for "image.checkpoint.exr", or "….old-2.exr" and so on: none that was
/// kept before is lost.
std::string free_old_path(const std::string& checkpoint) {
  const std::string stem = std::filesystem::path(checkpoint).replace_extension(".old").string();
  std::string path = stem + ".exr";
  std::error_code ignored;
  for (int number = 2; std::filesystem::exists(path, ignored); ++number)
    path = fmt::format("{}-{}.exr", stem, number);
  return path;
}

}  // namespace

RawOutput::RawOutput(const RenderOptions& options, const OutputNames& names,
                     const std::string& image_path, Messages& messages)
    : options_(options), messages_(messages), is_named_(!options.raw.empty()) {
  if (is_named_) {
    path_ = output_path(options.raw, names, kRawExtension);
  } else if (options.checkpoint) {
    if (is_standard_output(image_path))
      throw UsageError("--checkpoint: beside standard output, --raw has to name the file");
    path_ = checkpoint_path(image_path);
  }
  if (options.checkpoint) schedule(0);
}

void RawOutput::add_to(FileUses& uses) const {
  uses.write(is_named_ ? "--raw" : "--checkpoint", path_, kResume);
}

bool RawOutput::is_there() const {
  std::error_code ignored;
  if (!is_named_ || std::filesystem::exists(path_, ignored)) return true;
  messages_.info("{} is not there: it is rendered again", path_);
  return false;
}

std::string RawOutput::obstacle() const {
  return path_.empty() ? "" : prepare_file(path_);
}

std::optional<RawFilm> RawOutput::source() const {
  std::error_code ignored;
  std::string from = options_.resume;
  if (options_.checkpoint && std::filesystem::exists(path_, ignored)) from = path_;
  if (from.empty()) return std::nullopt;
  try {
    return RawFilm(from);
  } catch (const ReadError& e) {
    if (is_named_ || from != path_) throw;
    set_aside(e.what());
    return std::nullopt;
  }
}

void RawOutput::set_aside(const std::string& why) const {
  const std::string kept = free_old_path(path_);
  std::filesystem::rename(path_, kept);
  messages_.warning("{}; it is kept as {}, and the render begins anew", why, kept);
}

void RawOutput::load(const RawFilm& film, const std::optional<SampleInterval>& samples,
                     RenderState& state) const {
  std::string why;
  if (const std::string what = difference(film.image(), image_); !what.empty())
    why = fmt::format("{}: is not of this image: {}", film.path(), what);
  else if (samples)
    if (const auto others = film.state().samples.outside_of(*samples); !others.empty())
      why = fmt::format("{}: has the samples {}, and only {} are asked for", film.path(),
                        to_string(others), to_string(*samples));
  if (!why.empty()) {
    if (is_named_ || film.path() != path_) throw ReadError(why);
    return set_aside(why);
  }
  film.add_to(state);
  messages_.info("goes on from {} with {} spp", film.path(), state.spp);
}

void RawOutput::after_pass(const RenderState& state) {
  if (!options_.checkpoint) return;
  const auto start = Clock::now();
  if (start < next_) return;
  try {
    write_raw_film(path_, image_, state);
    failure_.clear();
  } catch (const std::exception& e) {
    if (failure_.empty()) messages_.warning("no checkpoint: {}", e.what());
    failure_ = e.what();
  }
  const std::chrono::duration<double> took = Clock::now() - start;
  messages_.detail("{}: {} spp, written in {:.2f} s", path_, state.spp, took.count());
  schedule(took.count());
}

void RawOutput::schedule(double took) {
  // A large film is written less often, so that it takes about a hundredth of the time.
  const double wanted = *options_.checkpoint, most = 10 * wanted;
  const std::chrono::duration<double> interval(std::clamp(100 * took, wanted, most));
  next_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(interval);
}

std::string RawOutput::finish(const RenderState& state, bool interrupted) {
  if (path_.empty() || state.spp == 0) return "";
  if (is_named_ || interrupted) {
    write_raw_film(path_, image_, state);
    return path_;
  }
  if (!failure_.empty()) throw std::runtime_error("a checkpoint failed: " + failure_);
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
  return "";
}

}  // namespace duet
