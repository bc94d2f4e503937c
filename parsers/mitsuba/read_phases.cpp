// Phase functions.
#include <algorithm>
#include <cmath>

#include "mitsuba/readers.h"
#include "mitsuba/scene_reader.h"
#include "values/text.h"

namespace duet {

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

/// The nested phase functions; nothing after an error.
std::optional<std::vector<PhaseId>> nested_phases(SceneReader& s, Properties& p, size_t count) {
  const auto children = p.children(PluginKind::phase);
  if (children.size() != count) {
    s.report().error(p.node().where, "{} needs {} phase functions, not {}", describe(p.node()),
                     count, children.size());
    return std::nullopt;
  }
  std::vector<PhaseId> phases;
  for (const Properties::Child& c : children)
    if (const auto id = s.phase(*c.node)) phases.push_back(*id);
  return phases.size() == count ? std::optional(phases) : std::nullopt;
}

}  // namespace

void read_isotropic(SceneReader&, Properties&, PhaseDescription& out) {
  out.model = IsotropicPhase{};
}

void read_hg(SceneReader&, Properties& p, PhaseDescription& out) {
  const double g = p.number("g");
  if (!(std::abs(g) < 1)) p.error("g", "the anisotropy lies between -1 and 1, unlike {}", g);
  out.model = HenyeyGreensteinPhase{g};
}

void read_rayleigh(SceneReader&, Properties&, PhaseDescription& out) {
  out.model = RayleighPhase{};
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

void read_blendphase(SceneReader& s, Properties& p, PhaseDescription& out) {
  const FloatVolume weight = s.float_volume(p, "weight");
  if (const auto phases = nested_phases(s, p, 2))
    out.model = BlendPhase{weight, (*phases)[0], (*phases)[1]};
}

/// A chain of blends.
void read_mixturephase(SceneReader& s, Properties& p, PhaseDescription& out) {
  const auto weights = weight_list(p, "weights");
  if (weights.empty()) return;
  const auto phases = nested_phases(s, p, weights.size());
  if (!phases) return;
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
  PhaseId last = phases->back();
  double behind = weights.back();
  for (size_t i = weights.size() - 1; i-- > 0;) {
    const double sum = behind + weights[i];
    BlendPhase blend{sum > 0 ? behind / sum : 0.0, (*phases)[i], last};
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
    if (find_parameter(PluginKind::phase, *p.node().plugin, name)) p.find(name);
  out.model = IsotropicPhase{};
}

}  // namespace duet
