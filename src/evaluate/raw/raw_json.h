// What a raw film says of its image and of its samples, as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "evaluate/raw/raw_film.h"

namespace duet {

using Json = nlohmann::ordered_json;

/// What has to be equal for raw films to be of one image.
Json identity_json(const RawImage& image);
/// What else it says.
Json appearance_json(const RawImage& image);
/// Reads both. Throws nlohmann::json::exception for what is not there.
RawImage image_from_json(const Json& identity, const Json& appearance);

/// A state without the sums of its films.
Json state_json(const RenderState& state);
RenderState state_from_json(const Json& json);

}  // namespace duet
