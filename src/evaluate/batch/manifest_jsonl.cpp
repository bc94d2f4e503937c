// Manifests with a job as a JSON object in each line (JSON Lines).
#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "base/printable.h"
#include "evaluate/batch/manifest_fields.h"

namespace duet::batch {

namespace {

using JobJson = nlohmann::ordered_json;

/// Of what nlohmann says, the part that is not about itself.
std::string syntax_text(const std::string& what) {
  const size_t at = what.find("syntax error");
  return printable(at == what.npos ? what : what.substr(at));
}

/// A value as the command line has it; nothing if it has none.
std::optional<std::string> argument_text(const JobJson& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number() || value.is_boolean()) return value.dump();
  return std::nullopt;
}

class JobLine {
 public:
  JobLine(ManifestFields& fields, int line) : fields_(fields) {
    job_.where = {fields.file(), line, 0};
  }

  void read(std::string_view text, std::vector<Job>& jobs) {
    std::set<std::string> names;
    const auto watch = [&](int depth, JobJson::parse_event_t event, JobJson& parsed) {
      if (event == JobJson::parse_event_t::key && depth == 1) {
        const std::string name = parsed.get<std::string>();
        if (!names.insert(name).second) error("\"{}\" is there twice", printable(name));
      }
      return true;
    };
    JobJson json;
    try {
      json = JobJson::parse(text.begin(), text.end(), watch);
    } catch (const JobJson::parse_error& e) {
      SourceLocation where = job_.where;
      where.column = int(std::min(e.byte, text.size()));
      fields_.diagnostics().error(where, "this is no JSON: {}", syntax_text(e.what()));
      return;
    }
    if (!json.is_object()) {
      error("a job is an object: {{\"scene\": …}}");
      return;
    }
    for (const auto& [name, value] : json.items())
      if (const auto kind = fields_.kind(name, job_.where)) set(name, *kind, value);
    fields_.finish(std::move(job_), jobs);
  }

 private:
  template <class... Args>
  void error(fmt::format_string<Args...> text, Args&&... args) {
    fields_.diagnostics().error(job_.where, text, std::forward<Args>(args)...);
  }

  void set(const std::string& name, OptionKind kind, const JobJson& value) {
    if (value.is_null()) return;
    std::vector<std::string> texts;
    const bool is_list = value.is_array() && kind == OptionKind::repeatable;
    for (const JobJson& one : is_list ? value : JobJson::array({value})) {
      const auto text = argument_text(one);
      if (!text) {
        error("\"{}\" is {}", name,
              kind == OptionKind::repeatable ? "a text, a number or a list of them"
                                             : "a text, a number, true or false");
        return;
      }
      texts.push_back(*text);
    }
    fields_.set(job_, name, kind, std::move(texts));
  }

  ManifestFields& fields_;
  Job job_;
};

}  // namespace

void read_manifest_jsonl(const std::string& text, ManifestFields& fields, std::vector<Job>& jobs) {
  std::string_view left = text;
  if (left.starts_with("\xef\xbb\xbf")) left.remove_prefix(3);
  for (int line = 1; !left.empty(); ++line) {
    const size_t end = std::min(left.find('\n'), left.size());
    const std::string_view one = left.substr(0, end);
    left.remove_prefix(std::min(end + 1, left.size()));
    if (one.find_first_not_of(" \t\r") != one.npos) JobLine(fields, line).read(one, jobs);
  }
}

}  // namespace duet::batch
