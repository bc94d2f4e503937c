// BSDFs made of others that say more than which.
#include <algorithm>
#include <numeric>

#include "mitsuba/plugins/bsdf.h"
#include "mitsuba/plugins/bsdfs.h"
#include "values/text.h"

namespace duet::plugins {

namespace {

void read_twosided(SceneReader& s, Properties& p, MaterialDescription& out) {
  TwoSidedMaterial m;
  if (!read_nested(s, p, m)) return;
  // Light that passes such a surface would see one BSDF on its way and another on the way back.
  const bool allowed = p.boolean("allow_transmission");
  if (transmits(s.description(), m.front) || transmits(s.description(), m.back))
    s.report().error(p.node().where, "{} cannot hold a BSDF that lets light through{}",
                     describe(p.node()),
                     allowed ? " (\"allow_transmission\" is not supported)" : "");
  out.model = m;
}

constexpr Parameter kTwoSided[] = {{.name = "allow_transmission",
                                    .type = boolean,
                                    .preset = "false",
                                    .note = "a BSDF that lets light through is refused",
                                    .versions = v3}};

void read_mixturebsdf(SceneReader& s, Properties& p, MaterialDescription& out) {
  MixtureMaterial m;
  const std::string text = p.string("weights");
  const auto weights = parse_numbers(text);
  if (!weights || weights->empty() || *std::min_element(weights->begin(), weights->end()) < 0)
    return p.error("weights", "{} are not weights: numbers that are not negative", in_quotes(text));
  const double sum = std::accumulate(weights->begin(), weights->end(), 0.0);
  const auto ids = nested_bsdfs(s, p, weights->size(), weights->size());
  if (sum > 1)
    s.report().warning(p.where("weights"), "the weights sum to {:.4g}: they are divided by that",
                       sum);
  for (size_t i = 0; i < ids.size(); ++i)
    m.parts.emplace_back((*weights)[i] / std::max(sum, 1.0), ids[i]);
  out.model = m;
}

}  // namespace

Plugin twosided() {
  return {.name = "twosided",
          .parameters = kTwoSided,
          .reader = &read_twosided,
          .note = "holds one or two BSDFs"};
}

Plugin mixturebsdf() {
  return bsdf<MixtureMaterial>(
      {.reader = &read_mixturebsdf, .note = "holds BSDFs; Mitsuba 3 has none"});
}

}  // namespace duet::plugins
