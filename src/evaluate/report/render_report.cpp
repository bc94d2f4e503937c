#include "evaluate/report/render_report.h"

#include <fmt/format.h>

#include "base/percent.h"
#include "base/seconds_text.h"
#include "evaluate/report/statistics.h"

namespace duet {

std::string describe(const RenderRecord& record, const RenderResult& r) {
  std::string text = fmt::format("{}{} spp in {}", r.interrupted ? "interrupted, " : "", r.spp,
                                 seconds_text(r.seconds));
  if (r.relative_rmse)
    text += fmt::format(", relative standard error {}{}{}", r.rmse_is_upper_bound ? "below " : "",
                        percent(*r.relative_rmse), record.noise_only ? " (noise only)" : "");
  return text;
}

std::string target_miss(const RenderRecord& record, const RenderResult& r) {
  const RenderBudget& budget = record.requested;
  if (!budget.target_error || target_met(record, r)) return "";
  const std::string target = "--target-error " + percent(*budget.target_error);
  if (!r.relative_rmse)
    return fmt::format("{}: {}", target,
                       r.interrupted ? "interrupted before the error was known"
                                     : "the error is not known, or the image is black");
  return fmt::format("{} is not met: the estimate is {}, and {}", target, percent(*r.relative_rmse),
                     r.interrupted                        ? "the render was interrupted"
                     : budget.spp && r.spp >= *budget.spp ? "the samples of --spp are used up"
                                                          : "the time is used up");
}

}  // namespace duet
