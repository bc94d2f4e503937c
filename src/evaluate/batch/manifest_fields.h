// What the names and values of a manifest mean, whatever its format.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "evaluate/batch/job.h"

namespace duet::batch {

class ManifestFields {
 public:
  /// `manifest` is the path of the file.
  ManifestFields(std::string manifest, const std::vector<RenderOption>& options,
                 Diagnostics& diagnostics);

  Diagnostics& diagnostics() { return diagnostics_; }
  const std::shared_ptr<const std::string>& file() const { return file_; }
  /// What a name takes; nothing, with an error, if jobs have nothing of that name.
  std::optional<OptionKind> kind(const std::string& name, const SourceLocation& where);
  /// Gives a job the values of a name that there is.
  void set(Job& job, const std::string& name, OptionKind kind, std::vector<std::string> values);
  /// Adds a job that has everything; without a scene it is an error.
  void finish(Job job, std::vector<Job>& jobs);

 private:
  std::string in_folder(const std::string& path) const;

  std::shared_ptr<const std::string> file_;
  std::string folder_;
  const std::vector<RenderOption>& options_;
  Diagnostics& diagnostics_;
};

/// The formats.
void read_manifest_csv(const std::string& text, ManifestFields& fields, std::vector<Job>& jobs);
void read_manifest_jsonl(const std::string& text, ManifestFields& fields, std::vector<Job>& jobs);

}  // namespace duet::batch
