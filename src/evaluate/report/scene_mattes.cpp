#include "evaluate/report/scene_mattes.h"

#include <algorithm>

#include "evaluate/report/matte_header.h"

namespace duet {

namespace {

/// Whether the method's camera sees no surfaces that shine.
bool hides_emitters(const IntegratorDescription& integrator) {
  bool hides = false;
  const auto look = [&]<class M>(const FieldFacts& facts, const M& value) {
    if constexpr (std::is_same_v<M, bool>) hides |= facts.name() == "hide_emitters" && value;
  };
  std::visit([&](const auto& method) { for_each_field(method, look); }, integrator.method);
  return hides;
}

}  // namespace

SceneMattes::SceneMattes(const std::vector<MatteKind>& kinds,
                         const IntegratorDescription& integrator)
    : kinds_(kinds), hides_lights_(hides_emitters(integrator)) {}

std::vector<std::string> SceneMattes::with_channels(std::vector<std::string> channels) const {
  for (const MatteKind kind : kinds_)
    for (std::string& name : matte_channels(kind)) channels.push_back(std::move(name));
  return channels;
}

void SceneMattes::ask_for_names(SceneDescription& description, BuildOptions& build) {
  if (kinds_.empty()) return;
  name_unnamed(description);
  build.names = &names_;
}

double SceneMattes::memory_bytes(const FilmLayout& layout, bool moves) const {
  // Beside the mattes: the image with their layers, the same as it is converted, and the file,
  // which grows by copying.
  constexpr double kCopies = 4;
  return kCopies * matte_bytes(layout, kinds_.size(), false) +
         matte_bytes(layout, kinds_.size(), moves);
}

void SceneMattes::add(const Scene& scene, const FilmLayout& layout, const RenderRequest& request,
                      RenderResult& result, ImageForm& form, HeaderFields& header) const {
  if (kinds_.empty()) return;
  const Image mattes = render_mattes(scene, names_, layout,
                                     {kinds_, request.sequence, request.seed, uint32_t(result.spp),
                                      request.threads, hides_lights_});
  const Image image = std::move(result.image);
  Image all(image.width, image.height, with_channels(image.channels));
  const size_t own = image.channels.size(), more = mattes.channels.size();
  for (int y = 0; y < all.height; ++y)
    for (int x = 0; x < all.width; ++x) {
      std::copy_n(image.pixel(x, y), own, all.pixel(x, y));
      std::copy_n(mattes.pixel(x, y), more, all.pixel(x, y) + own);
    }
  result.image = std::move(all);
  form.full_precision.insert(form.full_precision.end(), mattes.channels.begin(),
                             mattes.channels.end());
  for (const MatteKind kind : kinds_)
    for (HeaderField& field : matte_header(kind, names_)) header.push_back(std::move(field));
}

}  // namespace duet
