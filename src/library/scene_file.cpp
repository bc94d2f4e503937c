#include "duet/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "evaluate/report/scene_json.h"
#include "evaluate/report/scene_summary.h"
#include "library/contents.h"

namespace duet {

namespace {

/// The name that a scene from a text has in messages.
constexpr const char* kTextName = "<string>";

std::string all_errors(const std::vector<SceneMessage>& messages) {
  std::string text;
  for (const SceneMessage& m : messages)
    if (m.is_error) text += (text.empty() ? "" : "\n") + m.text;
  return text;
}

}  // namespace

ReadingOptions reading_options(const SceneFileOptions& options) {
  for (const std::string& folder : options.search_paths) check_path(folder);
  ReadingOptions reading;
  reading.defines = options.defines;
  reading.search_paths = options.search_paths;
  return reading;
}

LoadedScene read_or_throw(const std::string& name, const ReadingOptions& options) {
  Diagnostics diagnostics;
  std::optional<LoadedScene> scene = read_scene(name, options, diagnostics);
  if (!scene || diagnostics.has_errors()) throw SceneError(scene_messages(diagnostics));
  return std::move(*scene);
}

std::vector<SceneMessage> scene_messages(const Diagnostics& diagnostics) {
  std::vector<SceneMessage> messages;
  for (const Diagnostic& d : diagnostics.summary())
    messages.push_back({d.severity == Severity::error, d.where.file ? *d.where.file : "",
                        d.where.line, d.where.column, d.to_string()});
  return messages;
}

void check_path(const std::string& path) {
  const size_t end = path.find('\0');
  if (end != std::string::npos)
    throw std::invalid_argument(
        fmt::format("{}: a path cannot go on with a zero byte", path.substr(0, end)));
}

SceneError::SceneError(std::vector<SceneMessage> messages)
    : std::runtime_error(all_errors(messages)), messages_(std::move(messages)) {}

const SceneMessage& SceneError::first() const {
  static const SceneMessage no_message;
  const auto error = std::find_if(messages_.begin(), messages_.end(),
                                  [](const SceneMessage& m) { return m.is_error; });
  return error == messages_.end() ? no_message : *error;
}

SceneFile SceneFile::load(const std::string& path, const SceneFileOptions& options) {
  check_path(path);
  const ReadingOptions reading = reading_options(options);
  return SceneFile(std::make_shared<const Contents>(Contents{path, read_or_throw(path, reading)}));
}

SceneFile SceneFile::from_text(const std::string& text, const SceneFileOptions& options) {
  ReadingOptions reading = reading_options(options);
  reading.files.read = [&text, on_disk = with_disk({}).read](const std::string& path) {
    return path == kTextName ? std::optional(text) : on_disk(path);
  };
  return SceneFile(
      std::make_shared<const Contents>(Contents{kTextName, read_or_throw(kTextName, reading)}));
}

const std::string& SceneFile::name() const {
  return contents_->name;
}

std::vector<std::string> SceneFile::warnings() const {
  std::vector<std::string> texts;
  for (const Diagnostic& d : contents_->loaded.warnings) texts.push_back(d.to_string());
  return texts;
}

std::string SceneFile::info_json() const {
  return json_text(scene_json(contents_->name, contents_->name, contents_->loaded));
}

std::string SceneFile::summary() const {
  return scene_summary(contents_->loaded, false);
}

}  // namespace duet
