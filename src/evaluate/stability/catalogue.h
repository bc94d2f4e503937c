// The failure catalogue as data: scenes, what is measured on them, and what is expected of each
// method there. scenes/stability/README.md describes the file.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace duet::stability {

/// The catalogue cannot be used; the message says where and why.
class CatalogueError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The methods whose behaviour the catalogue knows, in the order of the table.
inline constexpr std::array<const char*, 8> kMethods{"path", "ptracer", "bdpt", "reuse",
                                                     "ppm",  "bpm",     "vcm",  "auto"};
/// It runs one of the others, so it is looked at only in rows that name it.
inline constexpr std::string_view kChoice = "auto";
/// Whether a method merges, and so is biased however many samples it takes of one radius.
bool merges(const std::string& method);

/// Names and values: of a scene's $parameters or of a method's.
using Settings = std::map<std::string, std::string>;
/// Settings for each method; those under "*" are for all that have none of their own by that name.
using MethodSettings = std::map<std::string, Settings>;

enum class Expected { holds, fails, not_applicable };

/// What a method is expected to do in a row.
struct Expectation {
  Expected verdict = Expected::holds;
  double least = 0, most = 0;  ///< of the measured number, where a failure is known
  std::string why;             ///< why it fails or does not apply
};

/// The same measurement under other circumstances. A row holds if it holds in all of its variants.
struct Variant {
  std::string label;
  Settings defines;
  MethodSettings parameters;
  std::optional<double> value;  ///< that the mean of the image has here
};

/// What images are compared with: those of a method, or a value.
struct Reference {
  std::string method;  ///< "self" is the method under test; "" if there is a value instead
  std::string scene;   ///< file; the row's if empty
  Settings defines, parameters;
  /// The sum of the images with these further defines, if there are any.
  std::vector<Settings> sum;
  bool fixed = false;        ///< variants do not apply to it
  bool independent = false;  ///< with the independent sampler
  int spp = 0, batches = 0;
  std::optional<double> value;  ///< of every pixel
};

/// A part of the image: x0, y0, x1, y1 as shares of its size.
using Region = std::array<double, 4>;

/// Scenes drawn at random: of each name one of the texts, or a number between two on a log scale.
struct Draw {
  struct Name {
    std::string name;
    std::vector<std::string> texts;
    double least = 0, most = 0;
  };
  int count = 0;
  std::vector<Name> names;
};

/// One row of the catalogue.
struct Row {
  std::string name;     ///< as on the command line
  int number = 0;       ///< of the failure; several rows may look at one
  std::string title;    ///< what goes wrong, in a few words
  std::string about;    ///< why it does, and what is looked at
  std::string check;    ///< the statistic: a name of checks.h
  std::string scene;    ///< file
  bool fast = false;    ///< part of the short run
  std::string planned;  ///< why it cannot run yet; "" if it can
  Settings defines;
  MethodSettings parameters;
  std::map<std::string, double> effort;  ///< per method: multiplies the samples
  int spp = 16, batches = 16;
  bool independent = false;  ///< the independent sampler instead of Sobol' points
  std::vector<Variant> variants;
  Draw draw;
  Reference reference;
  std::optional<double> limit;   ///< of the statistic, instead of its own
  std::optional<double> margin;  ///< share of a mean that merging may be off by, instead of its own
  int tiles = 4;                 ///< per side of the image
  int most_batches = 4096;       ///< images of a series that grows until a deviation is seen
  /// Images end when their error is estimated to be this; `spp` does not count.
  std::optional<double> target_error;
  Region region{0, 0, 1, 1}, over{0, 0, 1, 1};
  std::map<std::string, Expectation> methods;
};

struct Catalogue {
  std::string folder;
  std::vector<Row> rows;
  /// Cells of the whole table that are measured: the tests that share one level of significance.
  int measured_cells() const;
};

/// The folder with the catalogue of Duet: installed beside the program or the library that this
/// code is in, or else in the source tree that it was built from.
std::string catalogue_folder();
/// Reads FOLDER/catalogue.json. Throws CatalogueError.
Catalogue read_catalogue(const std::string& folder);

/// The settings of a method among those of all.
Settings settings_for(const MethodSettings& all, const std::string& method);
/// `over` wins over `under`.
Settings merged(Settings under, const Settings& over);

}  // namespace duet::stability
