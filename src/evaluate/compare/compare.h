// Compares one image with its reference, two sets of images, or two directories.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/messages.h"
#include "evaluate/compare/figures.h"
#include "evaluate/compare/linear_image.h"
#include "evaluate/web/page.h"

namespace duet {

/// Where images of differences go; "" for none.
struct DifferencePaths {
  std::string diff, false_colour, flip_map;
};

/// What is compared, and what is asked of it.
struct CompareSettings {
  std::string image, reference;  ///< files, or directories
  std::string variance;          ///< of one sample of the reference, or ""
  /// Samples per pixel of the image and of the reference; without them what the headers say.
  std::optional<double> spp, reference_spp;
  DifferencePaths differences;
  std::vector<Requirement> requirements;
  bool require_complete = false;  ///< of two directories: both have the same files
  bool for_page = false;          ///< whether images for compare_page() are wanted
  int threads = 1;
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
  /// For the page.
  std::vector<ViewedImage> images;
  /// Whether there are figures.
  bool compared() const { return failure.empty() && only_in.empty(); }
  /// Whether every requirement is met. An image with holes meets none, nor does one that was not
  /// rendered; what has no reference has none, unless all must be complete.
  bool met(const CompareSettings& settings) const {
    if (!only_in.empty())
      return !settings.require_complete && (settings.requirements.empty() || only_in == "image");
    return failure.empty() && missed.empty() &&
           (settings.requirements.empty() || verdict != Verdict::fail);
  }
};
/// The verdict, or ERROR, or MISSING for a file that only one of two directories has.
std::string outcome_name(const Comparison& comparison);
/// The requirements that are missed, with what was measured; "" if there are none.
std::string missed_text(const Comparison& comparison);
/// Why there are no figures, in words; "" if there are.
std::string absence(const CompareSettings& settings, const Comparison& comparison);
/// One sentence about all: how many were compared and with which outcomes, what missed a threshold,
/// and what is missing on which side.
std::string summary_of(const CompareSettings& settings, const std::vector<Comparison>& all);

/// Measures everything of an image. `longest` is the longest side of its images for the page.
void measure(const LinearImage& image, const LinearImage& reference,
             const std::optional<NoiseModel>& noise, const CompareSettings& settings, int longest,
             Comparison& comparison);
/// Throws std::runtime_error if figures are required that tell bias from noise, of an image that
/// was denoised: its error is bias, of a size that nobody knows.
void refuse_denoised(const CompareSettings& settings, const LinearImage& image,
                     const std::string& path);
/// Writes the images of differences that the settings ask for.
void write_differences(const CompareSettings& settings, const Image& image, const Image& reference,
                       const ImageMetrics& metrics);

/// Longest side of an image on the page of one comparison.
inline constexpr int kLongestOfOne = 1024;
/// One image and its reference. Throws if one cannot be read, and UnknownSamples.
Comparison compare_pair(const CompareSettings& settings, int longest = kLongestOfOne);
/// The images of two sets of files, of two at least. Throws as above.
Comparison compare_sets(const CompareSettings& settings, const std::vector<std::string>& images,
                        const std::vector<std::string>& references);
/// Every image of a directory with the one of the same name in the other, in the order of their
/// names; a failure is part of its Comparison, and so is that only one directory has it. Each is
/// passed on as soon as it is there. Throws if the reference has no images, and UnknownSamples.
std::vector<Comparison> compare_directories(const CompareSettings& settings,
                                            const std::function<void(const Comparison&)>& compared);

/// Image files in a directory and those below it, as sorted paths relative to it.
std::vector<std::string> images_in(const std::string& directory);
/// The files that a set of images consists of: a directory, a pattern with * and ? as in a shell,
/// or names with commas between them.
std::vector<std::string> images_of_set(const std::string& set);
/// The same for an operand of --batches. Throws UsageError if they are not two at least, and warns
/// of few; `what` says whose they are.
std::vector<std::string> set_of_images(const std::string& operand, const char* what,
                                       Messages& messages);

/// The outcomes as a page, which mentions the command that made it, and as JUnit's XML, which
/// continuous integration servers read.
std::string compare_page(const CompareSettings& settings, const std::vector<Comparison>& all,
                         const std::string& command_line);
std::string junit_report(const CompareSettings& settings, const std::vector<Comparison>& all);

}  // namespace duet
