// Comma-separated values as RFC 4180 has them: fields in quotes may hold commas, lines and doubled
// quotes.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"

namespace duet::batch {

struct CsvRow {
  int line = 0;  ///< on which it begins, from 1
  std::vector<std::string> fields;
};

/// All rows; lines without any character are none. Lines may end with or without a carriage return,
/// and the text may begin with a byte order mark. Quotes that are not as they should be are errors
/// at their place in `file`.
std::vector<CsvRow> read_csv(std::string_view text, const std::shared_ptr<const std::string>& file,
                             Diagnostics& diagnostics);

}  // namespace duet::batch
