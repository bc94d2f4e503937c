// The options of `duet compare`.
#pragma once

#include <string>
#include <vector>

#include "evaluate/compare/compare.h"
#include "evaluate/render/file_uses.h"

namespace CLI {
class App;
}

namespace duet {

struct CompareOptions {
  CompareSettings settings;
  std::string html, junit;
  bool json = false;
  bool batches = false;      ///< both operands mean a set of images
  bool directories = false;  ///< both operands are directories
};

/// Adds the options to a command; `finish` is to be called once they are parsed and throws
/// UsageError for values that make no sense.
class CompareOptionParser {
 public:
  explicit CompareOptionParser(CLI::App& command);
  CompareOptions finish(int threads);

 private:
  void add_outputs(CLI::App& command);
  void check_available(const Requirement& required) const;
  void check() const;
  void check_files() const;
  /// The files that are compared.
  FileUses read_files() const;

  CompareOptions options_;
  std::string spp_, reference_spp_;
  std::vector<std::string> require_;
};

/// FIGURE<LIMIT or FIGURE>LIMIT. Throws UsageError for what is not like that or names no figure.
Requirement parse_requirement(const std::string& text);

}  // namespace duet
