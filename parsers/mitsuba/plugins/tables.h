// The plugins of each kind, in the order in which they are listed.
#pragma once

#include <optional>
#include <utility>

#include "math/fov.h"
#include "mitsuba/plugins/bsdfs.h"
#include "values/medium_presets.h"

namespace duet::plugins {

/// The note of a transform that may change with time.
inline constexpr const char* kMovable = "in 0.x also an `<animation>`";

std::vector<Plugin> scenes();
std::vector<Plugin> integrators();
std::vector<Plugin> sensors();
std::vector<Plugin> films();
std::vector<Plugin> rfilters();
std::vector<Plugin> samplers();
std::vector<Plugin> shapes();
std::vector<Plugin> textures();
std::vector<Plugin> emitters();
std::vector<Plugin> phases();
std::vector<Plugin> media();
std::vector<Plugin> subsurfaces();
std::vector<Plugin> volumes();

// Parts of these lists, each in a file of its own.
/// Images (texture_bitmap.cpp), and colours by their spectra (spectra.cpp).
Plugin bitmap();
std::vector<Plugin> spectra();
/// Sun and sky (emitter_sky.cpp).
std::vector<Plugin> skies();
/// Sensors that measure, and the batch of sensors (sensor_meters.cpp); `response` is the parameter
/// that they refuse.
std::vector<Plugin> meters(const Parameter& response);

// What the files about a kind share.
/// An error unless the parameter "gamma" has a value that means something.
void check_gamma(Properties& p, std::optional<double> gamma);
/// The share of the light in the choice of a light.
void read_weight(Properties& p, LightDescription& out);
/// What all sensors have: place, clipping planes, medium, film and sampler.
void read_sensor(SceneReader& s, Properties& p, SensorDescription& out);
/// From the parameters `fov` and `fov_axis`, or `focal_length`.
std::pair<double, FovAxis> read_fov(Properties& p);
/// The coefficients of the parameter "material"; null after an error.
const MediumPreset* medium_preset(Properties& p);

/// One list after the other.
std::vector<Plugin> joined(std::initializer_list<std::vector<Plugin>> lists);

// The parameters that all plugins of a kind have.
ParameterList sensor_parameters();
ParameterList film_parameters();
ParameterList sampler_parameters();

/// A plugin that is known, and never supported.
inline Plugin refused_plugin(std::string_view name, FileVersions versions, std::string_view why,
                             std::string_view parameters = "") {
  return {.name = name,
          .versions = versions,
          .note = why,
          .support = Support::refused,
          .refused_parameters = parameters};
}

}  // namespace duet::plugins
