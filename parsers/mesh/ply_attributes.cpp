#include "mesh/ply_attributes.h"

#include <algorithm>
#include <array>
#include <set>

namespace duet {

namespace {

/// The letters or digits that may count the channels of an attribute.
constexpr std::array<std::string_view, 4> kSuffixes{"xyzw", "rgba", "0123", "1234"};
constexpr size_t kColorSuffixes = 1;

/// Collects the groups while the properties are walked through in their order.
class Grouping {
 public:
  Grouping(const std::string& prefix, std::vector<PlyAttribute>& result)
      : prefix_(prefix), result_(result) {}

  /// Ends the current group; it counts if it has one or three channels.
  void end() {
    if (group_.size() == 1 || group_.size() == 3) {
      const bool color = suffixes_ == kColorSuffixes;
      result_.push_back({prefix_ + stem_ + (color ? "_color" : ""), group_, false});
      done_.insert(stem_);
    }
    group_.clear();
  }

  void add(int index, const std::string& name) {
    const size_t bar = name.rfind('_');
    if (bar == name.npos || bar + 2 != name.size()) return end();
    const std::string stem = name.substr(0, bar);
    const char suffix = name.back();
    if (!group_.empty() && stem != stem_) end();
    if (group_.empty()) {
      if (done_.count(stem)) return;
      suffixes_ = 0;
      while (suffixes_ < kSuffixes.size() && kSuffixes[suffixes_][0] != suffix) ++suffixes_;
      if (suffixes_ == kSuffixes.size()) return;
      stem_ = stem;
      group_ = {index};
    } else if (group_.size() < 4 && kSuffixes[suffixes_][group_.size()] == suffix) {
      group_.push_back(index);
    } else {
      // Out of order: the name is of no more use.
      done_.insert(stem_);
      group_.clear();
    }
  }

 private:
  const std::string& prefix_;
  std::vector<PlyAttribute>& result_;
  std::vector<int> group_;
  std::string stem_;
  size_t suffixes_ = 0;
  std::set<std::string> done_;
};

}  // namespace

std::vector<PlyAttribute> group_attributes(const PlyElement& element, const std::string& prefix,
                                           const std::vector<int>& used, MeshDialect dialect) {
  std::vector<PlyAttribute> result;
  std::vector<std::array<const char*, 3>> colors{{"r", "g", "b"}, {"red", "green", "blue"}};
  if (dialect == MeshDialect::mitsuba0)
    colors.push_back({"diffuse_red", "diffuse_green", "diffuse_blue"});
  std::vector<int> taken = used;
  for (const auto& names : colors) {
    const std::vector<int> rgb{element.find(names[0]), element.find(names[1]),
                               element.find(names[2])};
    if (*std::min_element(rgb.begin(), rgb.end()) < 0) continue;
    result.push_back({prefix + "color", rgb, true});
    taken.insert(taken.end(), rgb.begin(), rgb.end());
    taken.push_back(element.find("a"));
    if (names[0] == std::string("red")) taken.push_back(element.find("alpha"));
    break;
  }

  Grouping grouping(prefix, result);
  for (int i = 0; i < int(element.properties.size()); ++i) {
    if (std::find(taken.begin(), taken.end(), i) != taken.end()) continue;
    const PlyProperty& p = element.properties[size_t(i)];
    p.is_list ? grouping.end() : grouping.add(i, p.name);
  }
  grouping.end();
  return result;
}

}  // namespace duet
