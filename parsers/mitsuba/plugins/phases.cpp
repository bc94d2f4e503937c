// Phase functions.
#include <algorithm>
#include <cmath>

#include "mitsuba/plugins/plugin.h"
#include "mitsuba/plugins/tables.h"

namespace duet::plugins {

namespace {

/// A list of numbers that are not negative; empty after an error.
std::vector<double> weight_list(Properties& p, std::string_view name) {
  const std::vector<double> numbers = p.numbers(name);
  for (const double v : numbers)
    if (v < 0) {
      p.error(name, "the value {} is negative", v);
      return {};
    }
  return numbers;
}

void check_hg(SceneReader&, Properties& p, HenyeyGreensteinPhase& hg) {
  if (!(std::abs(hg.g) < 1)) p.error("g", "the anisotropy lies between -1 and 1, unlike {}", hg.g);
}

void read_tabphase(SceneReader&, Properties& p, PhaseDescription& out) {
  const auto values = weight_list(p, "values");
  const bool usable = values.size() >= 2 && *std::max_element(values.begin(), values.end()) > 0;
  if (usable)
    out.model = TabulatedPhase{values};
  else if (p.has("values"))
    p.error("values", "a tabulated phase function needs at least two values that are not all zero");
}

void read_sggx(SceneReader& s, Properties& p, PhaseDescription& out) {
  const bool given = p.has("S");
  const ColorVolume matrix = s.color_volume(p, "S");
  if (const VolumeId* id = std::get_if<VolumeId>(&matrix))
    out.model = SggxPhase{*id};
  else if (given)
    p.error("S", "the matrix of {} is a volume with 6 channels", describe(p.node()));
}

/// A chain of blends.
void read_mixturephase(SceneReader& s, Properties& p, PhaseDescription& out) {
  const auto weights = weight_list(p, "weights");
  if (weights.empty()) return;
  const auto phases = nested_phases(s, p, weights.size());
  if (phases.empty()) return;
  double rest = 0;
  for (const double w : weights) rest += w;
  if (!(std::abs(rest - 1) < 1e-3))
    s.approximate_loudly(p.where("weights"),
                         "the weights of a mixture of phase functions are made to sum to 1");
  if (!(rest > 0)) {
    p.error("weights", "all weights are zero");
    return;
  }
  // From the last: each blend holds those behind it.
  PhaseId last = phases.back();
  double behind = weights.back();
  for (size_t i = weights.size() - 1; i-- > 0;) {
    const double sum = behind + weights[i];
    BlendPhase blend{sum > 0 ? behind / sum : 0.0, phases[i], last};
    behind = sum;
    if (i == 0) {
      out.model = blend;
      return;
    }
    last = s.add_phase({p.node().where, {}, blend});
  }
  out = s.description().phases[size_t(last)];
}

void read_fibre_phase(SceneReader& s, Properties& p, PhaseDescription& out) {
  s.approximate_loudly(p.node().where,
                       fmt::format("the phase function \"{}\" is isotropic", p.node().type));
  for (const char* name : {"ks", "kd", "exponent", "stddev"})
    if (p.knows(name)) p.find(name);
  out.model = IsotropicPhase{};
}

template <class T, auto kCheck = nullptr>
Plugin phase(Plugin row = {}) {
  return plugin_of<T, PhaseDescription, kCheck>(std::move(row));
}

/// A parameter of a plugin that is approximated by another, which has no such parameter.
constexpr Parameter without_effect(std::string_view name) {
  return {name, number, "", "has no effect", any, v0, approximated};
}

}  // namespace

std::vector<Plugin> phases() {
  return {
      phase<IsotropicPhase>(),
      phase<HenyeyGreensteinPhase, check_hg>(),
      phase<RayleighPhase>(),
      phase<BlendPhase>({.versions = v3, .note = "holds two phase functions"}),
      phase<SggxPhase>({.versions = v3, .reader = &read_sggx, .note = "see `sggx-flakes` below"}),
      phase<TabulatedPhase>({.versions = v3, .reader = &read_tabphase}),
      {"kkay",
       v0,
       {without_effect("ks"), without_effect("kd"), without_effect("exponent")},
       &read_fibre_phase,
       "by isotropic",
       approximated},
      {"microflake", v0, without_effect("stddev"), &read_fibre_phase, "by isotropic", approximated},
      {"mixturephase", v0,
       Parameter{.name = "weights",
                 .type = string,
                 .note = "one for each phase function",
                 .required = true},
       &read_mixturephase, "holds phase functions"},
  };
}

}  // namespace duet::plugins
