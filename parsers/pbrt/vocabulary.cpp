#include "pbrt/vocabulary.h"

#include <fmt/format.h>

namespace duet::pbrt {

namespace {

std::string_view status_text(Status s) {
  constexpr std::string_view names[] = {"done", "approximated", "without effect", "ignored",
                                        "refused"};
  return names[size_t(s)];
}

std::string_view versions_text(Versions v) {
  return v == Versions::both ? "v3, v4" : v == Versions::v3 ? "v3" : "v4";
}

std::string types_text(Types types) {
  if ((types & kColor) == kColor) {
    std::string text = "colour";
    if (types & kNumber) text += " or number";
    if (types & kTexture) text += " or texture";
    return text;
  }
  std::string text;
  for (unsigned i = 0; i <= unsigned(Type::texture); ++i)
    if (types & (1u << i)) text += (text.empty() ? "" : " or ") + std::string(type_name(Type(i)));
  return text;
}

std::string parameter_text(const Spec& s) {
  std::string text = fmt::format("`{}` ({}", s.name, types_text(s.types));
  if (!s.preset.empty()) text += fmt::format(", {}", s.preset);
  if (!s.preset_v3.empty()) text += fmt::format(", in v3 {}", s.preset_v3);
  if (s.versions != Versions::both) text += fmt::format(", {} only", versions_text(s.versions));
  if (s.status != Status::done) text += fmt::format(", {}", status_text(s.status));
  text += ")";
  if (!s.note.empty()) text += fmt::format(": {}", s.note);
  return text;
}

constexpr std::string_view kIntroduction = R"(# What is read of pbrt's scene files

This file is printed by `duet plugins --pbrt` from the tables that the reader itself uses.

Files that end in `.pbrt` or `.pbrt.gz` are pbrt's, version 3 or 4. Which of the two is found from what the file uses;
`--pbrt-version` settles doubts. Every directive of both is understood. A plugin is done, approximated, or refused with
an error; its parameters, with their types and defaults, may also be without effect on what Duet does, or ignored with a
warning. Names that are in no table are warnings with the nearest known one.

- Colours are linear RGB in the colour space of the film, and so are those of images once they are read: their own space
  is the one that an OpenEXR file names, or sRGB. Spectra become such colours by the standard observer; a metal has one
  index per channel, a glass that of 587.6 nm. Dispersion, and colours that depend on the spectrum of the light, are
  lost. In v3 spectra have the colours of light on surfaces, too, and numbers in images of lights are taken as they are.
- Lights of v4 have the luminance that their scale says, whatever their spectrum; those of v3 are taken as they are.
- An area light's "power" is that of each triangle of a mesh, and of a quadric before its transform, since pbrt makes a
  light of each. Maps with "illuminance" are twice as bright as it says, as they are in pbrt.
- Diffuse surfaces of v4 reflect from 0 to 1, whatever their textures say. So do images in reflectances of v4, once a
  constant factor has multiplied them and before anything else is made of them.
- Surfaces that pbrt finds by formulas become meshes where Duet has no such shape; a patch that is not flat is divided
  finely enough not to be seen.
- Files of v3 may have parameters of another type than the known one, textures and materials that there are not, and
  directives on the wrong side of WorldBegin: pbrt-v3 goes on without them, and so does Duet, with a warning.
- A shape of v3 may have parameters of its material. What moves emits no light in v3, and what has no material in v4.
- Arrays of a mesh that do not fit its points, ends of blocks without beginnings, and colour spaces, mappings and presets
  of media that there are not, are left out with a warning, as in pbrt.
- What mirrors and glass show has shorter paths under sppm than in pbrt, which counts the surfaces that camera paths meet
  apart from those of photons.
- Several infinite lights add up. Lights do not move, as in pbrt: they stand where their way begins.
- Curves that are no hair face each ray as pbrt's do; only the methods that follow light from the camera alone can render
  such ribbons. Opaque ones are lit where rays are clear of them: a width in front of them, as in pbrt.
- Bumps on meshes with normals have pbrt's tangents: in v4 the second one is as long as the first, in v3 both are unit
  vectors turned backwards, so that bumps are dents and of another depth.
- The vertices of a displaced mesh move once, along its normals. A texture that looks at places sees those of the world,
  where pbrt gives it the mesh's own.
- Where light is scattered beneath surfaces paths have no limit of depth. A walk in a medium differs from pbrt's profiles
  where the surface is curved or thin: light that pbrt absorbs in the depth comes out on the other side.
- Textures are looked up without blur: pbrt blurs them by ray differentials, which many samples make small.
- The sensor's exposure, white balance and colour space are applied to the finished image.

)";

}  // namespace

std::vector<Row> all_rows() {
  std::vector<Row> rows;
  list_shapes(rows);
  list_lights(rows);
  list_materials(rows);
  list_textures(rows);
  list_media(rows);
  list_cameras(rows);
  list_films(rows);
  list_integrators(rows);
  return rows;
}

std::string vocabulary_markdown() {
  std::string text(kIntroduction);
  std::string_view kind;
  for (const Row& r : all_rows()) {
    if (r.kind != kind) {
      text += fmt::format(
          "{}## {}\n\n| name | versions | status | parameters |\n| --- | --- | --- | --- |\n",
          kind.empty() ? "" : "\n", r.kind);
      kind = r.kind;
    }
    std::string parameters;
    for (const auto list : {r.parameters, r.more})
      for (const Spec& s : list) parameters += (parameters.empty() ? "" : "; ") + parameter_text(s);
    text += fmt::format("| `{}` | {} | {}{}{} | {} |\n", r.name, versions_text(r.versions),
                        status_text(r.status), r.note.empty() ? "" : ": ", r.note, parameters);
  }
  return text;
}

}  // namespace duet::pbrt
