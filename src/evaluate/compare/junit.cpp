// The outcomes of comparisons as JUnit's XML, which continuous integration servers read.
#include <fmt/format.h>

#include <algorithm>

#include "evaluate/compare/compare.h"

namespace duet {

namespace {

/// What JUnit makes of an outcome.
enum class CaseResult { passed, failed, skipped, error };

CaseResult result_of(const CompareSettings& o, const Comparison& c) {
  if (!c.failure.empty()) return CaseResult::error;
  if (!c.met(o)) return CaseResult::failed;
  return c.compared() ? CaseResult::passed : CaseResult::skipped;
}

std::string why_failed(const CompareSettings& o, const Comparison& c) {
  if (!c.compared()) return absence(o, c);
  return c.missed.empty() ? "values that are not finite" : missed_text(c);
}

std::string outcome_element(const CompareSettings& o, const Comparison& c) {
  switch (result_of(o, c)) {
    case CaseResult::error:
      return fmt::format("    <error message=\"{}\"/>\n", escape_markup(c.failure));
    case CaseResult::failed:
      return fmt::format("    <failure type=\"{}\" message=\"{}\"/>\n",
                         escape_markup(outcome_name(c)), escape_markup(why_failed(o, c)));
    case CaseResult::skipped:
      return fmt::format("    <skipped message=\"{}\"/>\n", escape_markup(absence(o, c)));
    case CaseResult::passed:
      break;
  }
  return "";
}

}  // namespace

std::string junit_report(const CompareSettings& o, const std::vector<Comparison>& all) {
  const auto count = [&](CaseResult r) {
    return std::count_if(all.begin(), all.end(),
                         [&](const Comparison& c) { return result_of(o, c) == r; });
  };
  std::string xml = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<testsuite name=\"duet compare {}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" "
      "skipped=\"{}\">\n",
      escape_markup(o.reference), all.size(), count(CaseResult::failed), count(CaseResult::error),
      count(CaseResult::skipped));
  for (const Comparison& c : all) {
    xml += fmt::format("  <testcase classname=\"{}\" name=\"{}\">\n{}", escape_markup(o.image),
                       escape_markup(c.name), outcome_element(o, c));
    if (c.compared()) {
      xml += "    <system-out>";
      for (const Figure& f : figures(c.measurements))
        if (f.value) xml += fmt::format("{} {:.6g}\n", f.name, *f.value);
      xml += "</system-out>\n";
    }
    xml += "  </testcase>\n";
  }
  return xml + "</testsuite>\n";
}

}  // namespace duet
