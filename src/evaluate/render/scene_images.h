// The image files of one scene of `duet render`: what they are called, whether they are there
// already, and how they are written.
#pragma once

#include <string>
#include <vector>

#include "base/messages.h"
#include "evaluate/render/file_uses.h"
#include "evaluate/render/output.h"
#include "evaluate/render/render_options.h"
#include "evaluate/report/fingerprint.h"

namespace duet {

class SceneImages {
 public:
  /// `settings` is the fingerprint of everything that decides the colours of the image;
  /// `planned_spp` are the samples it is to get, as far as that is known.
  SceneImages(const RenderOptions& options, const std::string& scene, const OutputNames& names,
              const Fingerprint& settings, int planned_spp, Messages& messages);

  /// The files of a finished image: those of the image itself first, then those of the denoised
  /// one.
  std::vector<std::string> planned() const;
  /// Throws UsageError if one of them has another use.
  void add_to(FileUses& uses) const;
  /// Whether all planned files are finished images of these settings. One line says why one that is
  /// there is not.
  bool are_finished() const;
  /// What the first of the planned files says of its samples and its error.
  RenderResult stored_result() const;

  /// Writes the files of a finished image, or of one that is not (`result.interrupted`) under the
  /// names for those; returns the names. Partial images that this makes obsolete are removed.
  /// Throws std::runtime_error once the others have been written.
  std::vector<std::string> write(const RenderResult& result, const ImageForm& form,
                                 const HeaderFields& header);
  /// The same for the denoised image of the result that was written last.
  std::vector<std::string> write_denoised(const Image& image, const RenderResult& result,
                                          const ImageForm& form, const HeaderFields& header);

 private:
  enum class Kind { rendered, denoised };

  /// The files of a finished image with this many samples.
  std::vector<std::string> paths(Kind kind, int spp) const;
  /// The files of an image that is not finished.
  std::vector<std::string> partial_paths(Kind kind, int spp) const;
  /// Writes an image to the files of its kind; returns their names.
  std::vector<std::string> write_files(Kind kind, const Image& image, const RenderResult& result,
                                       const ImageForm& form, const HeaderFields& header) const;
  /// Of what decides the bytes of a file, for display or not.
  std::string settings_hash(Kind kind, const std::string& path) const;
  /// Whether the planned files of a kind are finished.
  bool are_finished(Kind kind) const;

  const RenderOptions& options_;
  std::string scene_;  ///< as headers say it
  OutputNames names_;
  Fingerprint settings_;
  int planned_spp_;
  Messages& messages_;
  std::vector<std::string> partial_;  ///< those that this run has written
};

}  // namespace duet
