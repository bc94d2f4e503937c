// What `duet compare` does with one image and its reference, with two sets, or with two
// directories.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/compare_figures.h"
#include "app/web_page.h"

namespace duet {

/// Longest side of an image in the report of one comparison.
inline constexpr int kLongestOfOne = 1024;

struct CompareOptions {
  std::string image, reference, variance;
  std::string diff, false_colour, flip_map, html, junit;
  std::string spp, reference_spp;
  std::vector<std::string> require;
  bool json = false, batches = false, require_complete = false;
  int threads = 1;
  std::vector<Requirement> requirements;  ///< what `require` says
};

/// The outcome of one comparison.
struct Comparison {
  std::string name;
  std::string failure;  ///< why there is none, or ""
  /// "image" or "reference" if only that one of two directories has the file, or "".
  std::string only_in;
  Measurements measurements;
  std::vector<Requirement> missed;
  Verdict verdict = Verdict::fail;
  bool tells_noise = false;  ///< whether noise and bias could be told apart
  std::string warning;       ///< what makes the figures misleading, or ""
  /// For the report.
  std::vector<ViewedImage> images;
  /// Whether there are figures.
  bool compared() const { return failure.empty() && only_in.empty(); }
  /// Whether every requirement is met. An image with holes meets none, nor does one that was not
  /// rendered; what has no reference has none, unless all must be complete.
  bool met(const CompareOptions& options) const {
    if (!only_in.empty())
      return !options.require_complete && (options.requirements.empty() || only_in == "image");
    return failure.empty() && missed.empty() &&
           (options.requirements.empty() || verdict != Verdict::fail);
  }
};
/// The verdict, or ERROR, or MISSING for a file that only one of two directories has.
std::string outcome_name(const Comparison& comparison);
/// The requirements that are missed, with what was measured; "" if there are none.
std::string missed_text(const Comparison& comparison);
/// Why there are no figures, in words; "" if there are.
std::string absence(const CompareOptions& options, const Comparison& comparison);
/// One sentence about all: how many were compared and with which outcomes, what missed a threshold,
/// and what is missing on which side.
std::string summary_of(const CompareOptions& options, const std::vector<Comparison>& all);

/// An image file in linear values. Throws ReadError.
struct LinearImage {
  Image image;
  bool display_encoded = false;
  std::string spp;  ///< that its header says, or ""
  /// All that its header says.
  std::vector<std::pair<std::string, std::string>> header;
};
LinearImage load_linear(const std::string& path);
/// Throws std::runtime_error if colours are not finite: a reference with holes would let everything
/// pass there.
void check_finite(const Image& image, const std::string& path);

/// Measures everything of an image. `longest` is the longest side of the images for the report, 0
/// for none.
void measure(const LinearImage& image, const LinearImage& reference,
             const std::optional<NoiseModel>& noise, const CompareOptions& options, int longest,
             Comparison& comparison);
/// Writes the images of differences that the options ask for.
void write_differences(const CompareOptions& options, const Image& image, const Image& reference,
                       const ImageMetrics& metrics);

/// One image and its reference. Throws if one cannot be read, or UsageError.
Comparison compare_pair(const CompareOptions& options, int longest);
/// Several images of each of two sides. Each side is a pattern with * or ?, a directory, or names
/// with commas between them. Throws as above.
Comparison compare_batches(const CompareOptions& options);
/// Every image of a directory with the one of the same name in the other, in the order of their
/// names; a failure is part of its Comparison, and so is that only one directory has it. Throws if
/// the reference has no images.
std::vector<Comparison> compare_directories(const CompareOptions& options);

/// Image files in a directory and those below it, as sorted paths relative to it.
std::vector<std::string> images_in(const std::string& directory);

/// The outcomes as a page, and as JUnit's XML, which continuous integration servers read.
std::string compare_page(const CompareOptions& options, const std::vector<Comparison>& all);
std::string junit_report(const CompareOptions& options, const std::vector<Comparison>& all);

}  // namespace duet
