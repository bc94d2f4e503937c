#include "evaluate/stability/explanations.h"

#include <fmt/format.h>

#include <set>

namespace duet::stability {

std::string about_table() {
  return "Every row is a small scene in `scenes/stability/` on which renderers of this kind have "
         "failed; every column a method. `duet stability` measures all of it again, and exits with "
         "1 if a method fails that should hold, holds where it is known to fail, fails by another "
         "amount than is known, or holds only because the measurement is too noisy to say. Seeds "
         "are fixed: the same program gives the same table.";
}

std::string about_level(const Catalogue& catalogue) {
  return fmt::format(
      "All tests together have a level of significance of {:g} %, shared by the {} cells (Šidák). "
      "Methods that merge are biased as long as their radius is not zero: in comparisons of means "
      "they hold if they differ by no more than a margin; so does `auto` where the method that it "
      "takes merges.",
      100 * kTableLevel, catalogue.measured_cells());
}

std::string about_power() {
  return fmt::format(
      "**Notices** is the smallest deviation that the measurement would have noticed with a "
      "probability of {:g} %. “Holds” counts only if that is no more than a bound: {:g} % of a "
      "tile or pixel, {:g} % of the mean of an image, or twice the margin if that is more; for "
      "other checks, values as far beyond the limit as the limit is from what is right (for “at "
      "least”: half the limit). Images are added until the bound is met (at most {} unless the row "
      "says otherwise). What still does not meet it is not resolved, and the table fails. Known "
      "failures have no bound. `--fast` renders fewer images and has bounds {:g} times as coarse.",
      100 * kPowerShare, 100 * kTileResolution, 100 * kMeanResolution, Row().most_batches,
      kFastFactor);
}

std::vector<const Check*> used_checks(const Catalogue& catalogue) {
  std::set<std::string> used;
  for (const Row& row : catalogue.rows) used.insert(row.check);
  std::vector<const Check*> found;
  for (const Check& c : checks())
    if (used.contains(c.name)) found.push_back(&c);
  return found;
}

}  // namespace duet::stability
