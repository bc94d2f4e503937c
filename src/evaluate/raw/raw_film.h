// Raw films: files with the exact sums of a render, from which it can go on, and which can be added
// up if they hold different samples of one image (docs/raw_film.md).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "evaluate/report/header.h"
#include "evaluate/report/image_form.h"
#include "integrators/render_state.h"

namespace duet {

/// What a raw film says of its image. Films are of one image if all of this is equal but for
/// `header`.
struct RawImage {
  std::string scene_hash;  ///< of the scene as it was built, whatever its files are called
  std::string integrator, parameters, techniques;
  std::optional<MethodDecision> decision;  ///< of `auto`
  std::string sampler;
  uint64_t seed = 0;
  std::optional<double> target_error;  ///< its samples follow from it
  FilmLayout layout;
  FilmContents contents;
  ImageForm form;
  bool noise_only = false;  ///< whether an estimate of the error leaves out a bias
  HeaderFields header;      ///< what images say of the scene and the method
};

/// The first thing in which two raw films are not of one image: `"seed" is 1, not 2`; empty if
/// there is none. That of `a` comes first.
std::string difference(const RawImage& a, const RawImage& b);

/// Writes a state that has films. Throws std::runtime_error, which names `path`; a file that was
/// there stays as it was then.
void write_raw_film(const std::string& path, const RawImage& image, const RenderState& state);

/// A raw film in a file. All functions throw ReadError, which names it.
class RawFilm {
 public:
  /// Reads all but the sums.
  explicit RawFilm(const std::string& path);
  const std::string& path() const { return path_; }
  const RawImage& image() const { return image_; }
  /// The state without films.
  const RenderState& state() const { return state_; }
  /// Adds its sums, samples and counters to a state, which gets films if it has none. A state that
  /// has films must have none of its samples. After an error the films are of no use.
  void add_to(RenderState& state) const;

 private:
  struct FilmCounts {
    int passes = 0;
    std::vector<uint64_t> tile_samples;
  };
  void read_text(const std::string& text);

  std::string path_, checksum_;
  RawImage image_;
  RenderState state_;
  std::vector<FilmCounts> films_;
};

}  // namespace duet
