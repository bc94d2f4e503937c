// What makes raw films films of one image.
#pragma once

#include <string>

#include "evaluate/raw/raw_film.h"

namespace duet {

/// A hash of the scene that a sensor sees, whatever its files are called and however many samples
/// it asks for.
std::string scene_identity(const SceneDescription& scene, size_t sensor);

/// The parts of a raw film's image that follow from these; `integrator` has begun.
RawImage raw_image(const RenderRecord& record, const Integrator& integrator,
                   const FilmLayout& layout);

/// Has `auto` take the decision of a film that is to be gone on from, if that is of a scene with
/// this identity and of the same settings of `auto`; other methods have none. Throws ReadError if
/// it is not one.
void adopt_decision(const RawFilm& film, const std::string& scene, const RenderRecord& record,
                    Integrator& integrator);

}  // namespace duet
