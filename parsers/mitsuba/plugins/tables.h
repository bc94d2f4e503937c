// The plugins of each kind, in the order in which they are listed.
#pragma once

#include "mitsuba/plugins/bsdfs.h"
#include "mitsuba/plugins/textures.h"
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
std::vector<Plugin> emitters();
std::vector<Plugin> phases();
std::vector<Plugin> media();
std::vector<Plugin> subsurfaces();
std::vector<Plugin> volumes();

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
