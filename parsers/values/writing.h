// What writers of scene files keep count of: what a format cannot express, and names.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace duet {

/// Sentences on what is lost, each once, in the order in which they came up.
class Losses {
 public:
  void add(std::string what) {
    if (std::find(list_.begin(), list_.end(), what) == list_.end())
      list_.push_back(std::move(what));
  }
  const std::vector<std::string>& list() const { return list_; }

 private:
  std::vector<std::string> list_;
};

/// Gives every thing of a file a name of its own.
class UniqueNames {
 public:
  /// `wanted`, if it is not empty and nothing has it yet; else `otherwise`, with a number behind it
  /// where that is taken.
  std::string take(const std::string& wanted, const std::string& otherwise) {
    if (!wanted.empty() && taken_.insert(wanted).second) return wanted;
    std::string name = otherwise;
    for (int i = 1; !taken_.insert(name).second; ++i) name = fmt::format("{}_{}", otherwise, i);
    return name;
  }

 private:
  std::set<std::string> taken_;
};

}  // namespace duet
