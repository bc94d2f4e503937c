// Comparisons of several images: two sets of renders, or two directories.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>

#include "base/failures.h"
#include "base/system/files.h"
#include "evaluate/compare/compare.h"
#include "evaluate/compare/independence.h"
#include "image/colours.h"

namespace duet {

namespace fs = std::filesystem;

namespace {

/// Longest side of an image on the page of directories: pages of hundreds of images should open.
constexpr int kLongestOfMany = 512;

/// Fewer images of a side than this leave their variance uncertain.
constexpr size_t kFewImagesOfSet = 8;

/// One side of a tile test.
struct Side {
  TileBatches batches;
  LinearImage mean;
  ImagesOfSet images;
};

Side load_side(const CompareSettings& settings, const std::vector<std::string>& files) {
  Side side;
  std::vector<double> sums;
  for (const std::string& file : files) {
    LinearImage image = load_linear(file);
    refuse_denoised(settings, image, file);
    try {
      side.batches.add(image.image);
    } catch (const std::invalid_argument& e) {
      throw std::runtime_error(fmt::format("{}: {}", file, e.what()));
    }
    side.images.add(image, file);
    const Colours colours(image.image);
    sums.resize(3 * colours.pixels());
    for (size_t i = 0; i < colours.pixels(); ++i)
      for (size_t c = 0; c < 3; ++c) sums[3 * i + c] += colours(i, int(c));
    side.mean.display_encoded |= image.display_encoded;
    side.mean.image = Image(image.image.width, image.image.height, {"R", "G", "B"});
  }
  for (size_t i = 0; i < sums.size(); ++i)
    side.mean.image.data[i] = float(sums[i] / double(files.size()));
  return side;
}

/// Adds to the warning of a comparison in what the images are not independent.
void add_warnings(const ImagesOfSet& images, const ImagesOfSet& references, Comparison& c) {
  for (const std::string& text :
       {images.warning(), references.warning(), images.shared_warning(references)})
    if (!text.empty()) c.warning += (c.warning.empty() ? "" : "; ") + text;
}

/// The images of one name in two directories.
Comparison compare_named(const CompareSettings& o, const std::string& name) {
  CompareSettings pair = o;
  pair.image = (fs::path(o.image) / name).string();
  pair.reference = (fs::path(o.reference) / name).string();
  if (!o.variance.empty()) pair.variance = (fs::path(o.variance) / name).string();
  try {
    return compare_pair(pair, kLongestOfMany);
  } catch (const UnknownSamples&) {
    throw;
  } catch (const std::exception& e) {
    Comparison c;
    c.failure = e.what();
    return c;
  }
}

}  // namespace

Comparison compare_sets(const CompareSettings& o, const std::vector<std::string>& images,
                        const std::vector<std::string>& references) {
  const Side a = load_side(o, images), b = load_side(o, references);
  check_finite(b.mean.image, o.reference);
  if (a.mean.image.width != b.mean.image.width || a.mean.image.height != b.mean.image.height)
    throw std::runtime_error(fmt::format("the images are {}x{}, the references {}x{}",
                                         a.mean.image.width, a.mean.image.height,
                                         b.mean.image.width, b.mean.image.height));
  Comparison c;
  c.name = o.image;
  c.measurements.tiles = compare_tiles(a.batches, b.batches);
  measure(a.mean, b.mean, std::nullopt, o, kLongestOfOne, c);
  add_warnings(a.images, b.images, c);
  write_differences(o, a.mean.image, b.mean.image, c.measurements.metrics);
  return c;
}

std::vector<Comparison> compare_directories(
    const CompareSettings& o, const std::function<void(const Comparison&)>& compared) {
  const std::vector<std::string> images = images_in(o.image), references = images_in(o.reference);
  if (references.empty()) throw std::runtime_error(fmt::format("{} has no images", o.reference));
  std::vector<std::string> names;
  std::set_union(images.begin(), images.end(), references.begin(), references.end(),
                 std::back_inserter(names));
  std::vector<Comparison> all;
  for (const std::string& name : names) {
    const bool rendered = std::binary_search(images.begin(), images.end(), name);
    if (rendered && std::binary_search(references.begin(), references.end(), name)) {
      all.push_back(compare_named(o, name));
    } else {
      all.emplace_back();
      all.back().only_in = rendered ? "image" : "reference";
    }
    all.back().name = name;
    compared(all.back());
  }
  return all;
}

std::string outcome_name(const Comparison& c) {
  if (!c.only_in.empty()) return "MISSING";
  return c.failure.empty() ? name_of(c.verdict) : "ERROR";
}

std::string absence(const CompareSettings& o, const Comparison& c) {
  if (c.only_in == "image") return fmt::format("no reference in {}", o.reference);
  if (c.only_in == "reference") return fmt::format("no image in {}", o.image);
  return c.failure;
}

std::string summary_of(const CompareSettings& o, const std::vector<Comparison>& all) {
  const auto count = [&](auto has) { return std::count_if(all.begin(), all.end(), has); };
  std::map<std::string, int> verdicts;
  for (const Comparison& c : all)
    if (c.compared()) ++verdicts[outcome_name(c)];
  std::string text =
      fmt::format("{} compared", count([](const Comparison& c) { return c.compared(); }));
  const char* separator = ": ";
  for (const auto& [name, number] : verdicts) {
    text += fmt::format("{}{} {}", separator, number, name);
    separator = ", ";
  }
  const auto add = [&](std::ptrdiff_t number, const std::string& what) {
    if (number > 0) text += fmt::format("; {} {}", number, what);
  };
  add(count([&](const Comparison& c) { return c.compared() && !c.met(o); }), "missed a threshold");
  add(count([](const Comparison& c) { return !c.failure.empty(); }), "could not be compared");
  add(count([](const Comparison& c) { return c.only_in == "image"; }),
      fmt::format("MISSING in {}", o.reference));
  add(count([](const Comparison& c) { return c.only_in == "reference"; }),
      fmt::format("MISSING in {}", o.image));
  return text;
}

std::vector<std::string> images_of_set(const std::string& set) {
  std::error_code ignored;
  std::vector<std::string> files;
  if (fs::is_directory(set, ignored)) {
    for (const std::string& name : images_in(set)) files.push_back((fs::path(set) / name).string());
    return files;
  }
  if (set.find_first_of("*?") != std::string::npos && !fs::exists(set, ignored)) {
    return files_of_pattern(set);
  }
  for (size_t from = 0; from <= set.size();) {
    const size_t to = std::min(set.find(',', from), set.size());
    if (to > from) files.push_back(set.substr(from, to - from));
    from = to + 1;
  }
  return files;
}

std::vector<std::string> set_of_images(const std::string& operand, const char* what,
                                       Messages& messages) {
  const std::vector<std::string> files = images_of_set(operand);
  if (files.size() < 2)
    throw UsageError(
        fmt::format("--batches: \"{}\" means {}; it must mean two images at least, as a pattern in "
                    "quotes such as "
                    "'a-*.exr', a directory, or names with commas between them",
                    operand, files.empty() ? "no image" : files[0] + " alone"));
  if (files.size() < kFewImagesOfSet)
    messages.warning(
        "--batches: {} images of the {} say little about its variance; {} or more are better",
        files.size(), what, 2 * kFewImagesOfSet);
  return files;
}

}  // namespace duet
