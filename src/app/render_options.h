// The options of `duet render`.
#pragma once

#include <string>
#include <vector>

#include "app/file_options.h"
#include "app/progress.h"
#include "evaluate/render/file_uses.h"
#include "evaluate/render/render_options.h"

namespace CLI {
class App;
}

namespace duet {

struct Program;

struct RenderCommandLine : RenderOptions {
  bool keep_going = true, require_target = false;
  std::string stats_file, log_file;
  FileUses uses;  ///< of all files that are named, but for images and raw films
  bool quiet = false, verbose = false;
  ProgressStyle progress = ProgressStyle::automatic;
  std::optional<uint16_t> live_port;  ///< of the page that shows the image; 0: any
};

/// Adds the options to a command; `finish` is to be called once they are parsed and throws
/// UsageError for values that make no sense, with all of them.
class RenderOptionParser {
 public:
  RenderOptionParser(CLI::App& command, Program& program);
  RenderCommandLine finish();

 private:
  void add_method_options(CLI::App& command);
  void add_image_options(CLI::App& command);
  void add_output_options(CLI::App& command);
  void add_raw_options(CLI::App& command);
  void finish_numbers();
  void finish_window();
  void finish_format();
  void finish_raw();
  void finish_live();
  void finish_method();
  void finish_uses();
  /// Reads the value of an option if it is given.
  template <class Read>
  void read(const std::string& text, const Read& read) {
    if (!text.empty()) checks_.run(read);
  }

  Program& program_;
  Checks checks_;
  RenderCommandLine options_;
  std::string spp_, time_, target_, size_, crop_, threads_, seed_, sensor_,
      progress_ = "auto", techniques_, format_, light_selection_, checkpoint_, samples_, slice_,
      viewer_, live_port_;
  bool live_ = false;
  std::vector<std::string> integrator_parameters_, layers_, mattes_;
  FileOptions files_;
};

}  // namespace duet
