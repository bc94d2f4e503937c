// The raw film of one scene of `duet render`: where it comes from, when it is written.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "base/messages.h"
#include "evaluate/raw/raw_film.h"
#include "evaluate/render/file_uses.h"
#include "evaluate/render/output.h"
#include "evaluate/render/render_options.h"

namespace duet {

class RawOutput {
 public:
  /// `image_path` is the first image of the scene, beside which checkpoints lie that have no name.
  /// Throws UsageError if there is no place for them.
  RawOutput(const RenderOptions& options, const OutputNames& names, const std::string& image_path,
            Messages& messages);

  /// Whether the render has to keep a state that it can go on from.
  bool keeps_state() const { return !path_.empty() || !options_.resume.empty(); }
  /// Throws UsageError if its file has another use.
  void add_to(FileUses& uses) const;
  /// Whether the film that the user has named is there, or none is named; one line says that it is
  /// not.
  bool is_there() const;
  /// Why it could not be written; empty if it can.
  std::string obstacle() const;
  /// What the render is to go on from, if there is anything. Throws ReadError for a film that the
  /// user has named.
  std::optional<RawFilm> source() const;
  /// What the film is of.
  void set_image(RawImage image) { image_ = std::move(image); }
  /// Reads a film's state. Throws ReadError if the user has named it and it is of another image, or
  /// has samples besides `samples`, if the user asks for some.
  void load(const RawFilm& film, const std::optional<SampleInterval>& samples,
            RenderState& state) const;

  /// Writes a checkpoint if it is time. One that cannot be written is an error in the end, and the
  /// render goes on nevertheless.
  void after_pass(const RenderState& state);
  /// Writes the film of a render that has ended, or removes the checkpoint that it makes
  /// obsolete; returns the name of the file, or "". Throws std::runtime_error if this or a
  /// checkpoint could not be written.
  std::string finish(const RenderState& state, bool interrupted);

 private:
  using Clock = std::chrono::steady_clock;
  /// A checkpoint that is of no use is not what the user has asked for, nor is it lost.
  void set_aside(const std::string& why) const;
  /// The next checkpoint, after one that took so many seconds.
  void schedule(double took);

  const RenderOptions& options_;
  Messages& messages_;
  std::string path_;       ///< empty if no raw film is written
  bool is_named_ = false;  ///< by the user: it stays
  RawImage image_;
  Clock::time_point next_;  ///< when there is to be a checkpoint
  std::string failure_;     ///< of the last checkpoint
};

}  // namespace duet
