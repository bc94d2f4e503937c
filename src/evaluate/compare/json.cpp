#include "evaluate/compare/json.h"

#include <nlohmann/json.hpp>

#include "evaluate/compare/verdict.h"

namespace duet {

namespace {

using Json = nlohmann::ordered_json;

Json region_json(const RegionTest& r) {
  return {{"x", r.x},
          {"y", r.y},
          {"width", r.width},
          {"height", r.height},
          {"channel", std::string(1, "RGB"[r.channel])},
          {"p", r.p},
          {"ratio", r.ratio}};
}

Json bias_test_json(const BiasTest& t) {
  return {{"p", t.p},
          {"significance", kBiasSignificance},
          {"tests", t.tests},
          {"tile", region_json(t.tile)},
          {"mean", region_json(t.mean)},
          {"ratio", t.ratio},
          {"ratio_error", t.ratio_error},
          {"bound95", t.bound95()},
          {"noticed_mean", t.noticed_mean},
          {"noticed_tile", t.noticed_tile},
          {"noticed_tile_worst", t.noticed_tile_worst},
          {"correlation", t.correlation},
          {"left_out", t.left_out}};
}

}  // namespace

nlohmann::ordered_json comparison_json(const CompareSettings& o, const Comparison& c) {
  Json j;
  if (!c.compared()) {
    if (!c.only_in.empty()) j["only_in"] = c.only_in;
    j["error"] = absence(o, c);
    j["verdict"] = outcome_name(c);
    return j;
  }
  const ImageMetrics& m = c.measurements.metrics;
  for (const Figure& f : figures(c.measurements)) j[f.name] = f.value ? Json(*f.value) : nullptr;
  if (m.bias) j["bias"] = *m.bias;
  j["mean_ratio"] = m.mean_ratio;
  if (const auto& t = c.measurements.tiles)
    j["tile_test"] = {{"p", t->p},
                      {"significance", kTileSignificance},
                      {"tile_p", t->tile_p},
                      {"z2_p", t->z2_p},
                      {"mean_p", t->mean_p},
                      {"tiles", t->tiles},
                      {"rejected", t->rejected},
                      {"mean_z2", t->mean_z2},
                      {"least_p", t->least_p},
                      {"worst_ratio", t->worst_ratio},
                      {"ratio", t->ratio},
                      {"ratio_error", t->ratio_error},
                      {"visible_bias", t->visible_bias},
                      {"visible_bias_worst", t->visible_bias_worst}};
  if (const auto& t = c.measurements.bias_test) j["bias_test"] = bias_test_json(*t);
  if (!c.warning.empty()) j["warning"] = c.warning;
  j["missed"] = texts_of(c.missed);
  j["verdict"] = name_of(c.verdict);
  j["known"] = known_text(c);
  return j;
}

nlohmann::ordered_json comparisons_json(const CompareSettings& o,
                                        const std::vector<Comparison>& all) {
  Json list = Json::array();
  for (const Comparison& c : all) {
    Json j{{"name", c.name}};
    j.update(comparison_json(o, c));
    list.push_back(j);
  }
  return list;
}

}  // namespace duet
