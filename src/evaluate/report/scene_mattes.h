// The mattes of one scene (Cryptomatte), if they are asked for.
#pragma once

#include <string>
#include <vector>

#include "evaluate/report/header.h"
#include "evaluate/report/image_form.h"
#include "integrators/matte_pass.h"
#include "scene/build.h"

namespace duet {

class SceneMattes {
 public:
  /// `integrator` is the one that renders the image.
  SceneMattes(const std::vector<MatteKind>& kinds, const IntegratorDescription& integrator);

  /// Those of an image with these channels, and of the mattes.
  std::vector<std::string> with_channels(std::vector<std::string> channels) const;
  /// Names all things and has the builder say which is which, if that is of interest.
  void ask_for_names(SceneDescription& description, BuildOptions& build);
  /// Bytes that the mattes take until they are written.
  double memory_bytes(const FilmLayout& layout, bool moves) const;

  /// Renders them, as layers of the image, with the header fields that readers need. `form` is told
  /// that their channels need 32 bits.
  void add(const Scene& scene, const FilmLayout& layout, const RenderRequest& request,
           RenderResult& result, ImageForm& form, HeaderFields& header) const;

 private:
  std::vector<MatteKind> kinds_;
  bool hides_lights_ = false;
  SceneNames names_;
};

}  // namespace duet
