#include "evaluate/raw/raw_json.h"

namespace duet {

namespace {

Json json_of(const PixelBounds& b) {
  return {b.x0, b.y0, b.width(), b.height()};
}
PixelBounds bounds_from(const Json& j) {
  const int x = j.at(0), y = j.at(1);
  return {x, y, x + j.at(2).get<int>(), y + j.at(3).get<int>()};
}

template <class T>
Json json_of(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}
template <class T>
std::optional<T> optional_from(const Json& j) {
  return j.is_null() ? std::nullopt : std::optional<T>(j.get<T>());
}

Json json_of(const FilterDescription& f) {
  return {{"kind", int(f.kind)},
          {"radius", f.radius},
          {"stddev", f.stddev},
          {"b", f.b},
          {"c", f.c},
          {"lobes", f.lobes},
          {"reach_x", json_of(f.reach_x)},
          {"reach_y", json_of(f.reach_y)}};
}
FilterDescription filter_from(const Json& j) {
  FilterDescription f;
  f.kind = FilterKind(j.at("kind").get<int>());
  f.radius = j.at("radius"), f.stddev = j.at("stddev"), f.b = j.at("b"), f.c = j.at("c");
  f.lobes = j.at("lobes");
  f.reach_x = optional_from<double>(j.at("reach_x"));
  f.reach_y = optional_from<double>(j.at("reach_y"));
  return f;
}

Json json_of(const FilmLayout& l) {
  Json j{{"size", {l.full.x, l.full.y}},     {"window", json_of(l.crop)},
         {"ends_at_window", l.ends_at_crop}, {"filter", json_of(l.filter)},
         {"response", json_of(l.response)},  {"sample_limit", nullptr}};
  if (l.sample_limit)
    j["sample_limit"] = {{"sensor", l.sample_limit->sensor}, {"most", l.sample_limit->most}};
  return j;
}
FilmLayout layout_from(const Json& j) {
  FilmLayout l;
  l.full = {j.at("size").at(0), j.at("size").at(1)};
  l.crop = bounds_from(j.at("window"));
  l.ends_at_crop = j.at("ends_at_window");
  l.filter = filter_from(j.at("filter"));
  l.response = optional_from<FilmResponse>(j.at("response"));
  if (const Json& limit = j.at("sample_limit"); !limit.is_null())
    l.sample_limit = {limit.at("sensor").get<FilmResponse>(), limit.at("most").get<double>()};
  return l;
}

Json json_of(const FilmContents& c) {
  Json statistics = Json::array();
  for (const FilmStatistic& s : c.statistics)
    statistics.push_back({{"kind", int(s.kind)}, {"channel", s.channel}});
  return {{"channels", c.channels},
          {"splats", c.splats},
          {"squares", c.moments},
          {"statistics", std::move(statistics)}};
}
FilmContents contents_from(const Json& j) {
  FilmContents c{j.at("channels"), j.at("splats"), j.at("squares"), {}};
  for (const Json& s : j.at("statistics"))
    c.statistics.push_back({FilmStatistic::Kind(s.at("kind").get<int>()), s.at("channel")});
  return c;
}

Json json_of(const std::optional<MethodDecision>& d) {
  if (!d) return nullptr;
  return {{"method", d->method}, {"parameters", d->parameters}, {"merge_parts", d->merge_parts}};
}
std::optional<MethodDecision> decision_from(const Json& j, const Json& appearance) {
  if (j.is_null()) return std::nullopt;
  MethodDecision d{j.at("method"), j.at("parameters"), appearance.at("reason"), {}};
  d.merge_parts = j.at("merge_parts").get<std::vector<uint8_t>>();
  d.bias = appearance.at("bias");
  return d;
}

Json json_of(const ImageForm& f) {
  Json j{{"pixel_format", int(f.pixel_format)},
         {"half", f.half},
         {"full_precision", f.full_precision},
         {"tone_mapping", nullptr}};
  if (const auto& t = f.tone_mapping)
    j["tone_mapping"] = {{"reinhard", t->reinhard},
                         {"gamma", t->gamma},
                         {"exposure", t->exposure},
                         {"key", t->key},
                         {"burn", t->burn}};
  return j;
}
ImageForm form_from(const Json& j, const FilmLayout& layout) {
  ImageForm f{layout.crop,
              layout.full,
              PixelFormat(j.at("pixel_format").get<int>()),
              j.at("half"),
              j.at("full_precision"),
              {}};
  if (const Json& t = j.at("tone_mapping"); !t.is_null())
    f.tone_mapping = {t.at("reinhard"), t.at("gamma"), t.at("exposure"), t.at("key"), t.at("burn")};
  return f;
}

Json json_of(const HeaderFields& fields) {
  Json j = Json::array();
  for (const auto& [name, value] : fields)
    j.push_back({name, std::visit([](const auto& v) { return Json(v); }, value)});
  return j;
}
HeaderFields header_from(const Json& j) {
  HeaderFields fields;
  for (const Json& field : j) {
    const Json& v = field.at(1);
    HeaderValue value;
    if (v.is_string())
      value = v.get<std::string>();
    else if (v.is_array())
      value = v.get<std::array<float, 16>>();
    else if (v.is_number_integer())
      value = v.get<int>();
    else
      value = v.get<float>();
    fields.emplace_back(field.at(0).get<std::string>(), std::move(value));
  }
  return fields;
}

Json json_of(const AllocatedSamples& a) {
  Json taken = Json::array();
  for (const auto& t : a.taken) taken.push_back({t.samples, t.passes});
  return {{"taken", std::move(taken)}, {"even", a.even}, {"rates", a.rates}};
}
AllocatedSamples allocated_from(const Json& j) {
  AllocatedSamples a;
  for (const Json& t : j.at("taken")) a.taken.push_back({t.at(0), t.at(1)});
  a.even = j.at("even");
  a.rates = j.at("rates");
  return a;
}

}  // namespace

Json identity_json(const RawImage& i) {
  return {{"scene", i.scene_hash},
          {"integrator", i.integrator},
          {"parameters", i.parameters},
          {"techniques", i.techniques},
          {"decision", json_of(i.decision)},
          {"sampler", i.sampler},
          {"seed", i.seed},
          {"target_error", json_of(i.target_error)},
          {"layout", json_of(i.layout)},
          {"contents", json_of(i.contents)}};
}

Json appearance_json(const RawImage& i) {
  Json j{{"form", json_of(i.form)}, {"noise_only", i.noise_only}, {"header", json_of(i.header)}};
  if (i.decision) j["reason"] = i.decision->reason, j["bias"] = i.decision->bias;
  return j;
}

RawImage image_from_json(const Json& j, const Json& appearance) {
  RawImage i;
  i.scene_hash = j.at("scene");
  i.integrator = j.at("integrator"), i.parameters = j.at("parameters");
  i.techniques = j.at("techniques");
  i.decision = decision_from(j.at("decision"), appearance);
  i.sampler = j.at("sampler"), i.seed = j.at("seed");
  i.target_error = optional_from<double>(j.at("target_error"));
  i.layout = layout_from(j.at("layout"));
  i.contents = contents_from(j.at("contents"));
  i.form = form_from(appearance.at("form"), i.layout);
  i.noise_only = appearance.at("noise_only");
  i.header = header_from(appearance.at("header"));
  return i;
}

Json state_json(const RenderState& s) {
  Json intervals = Json::array(), counters;
  for (const SampleInterval& i : s.samples.all()) intervals.push_back({i.first, i.end});
  RenderCounters::for_each(s.counters, s.counters,
                           [&](const char* name, uint64_t n, uint64_t) { counters[name] = n; });
  Json j{{"samples", std::move(intervals)},
         {"spp", s.spp},
         {"variance", {{"squares", s.variance.squares}, {"count", s.variance.count}}},
         {"counters", std::move(counters)},
         {"seconds", s.seconds}};
  const BatchRounds& r = s.rounds;
  if (s.films.size() > 1)
    j["rounds"] = {{"length", r.length}, {"spp", r.spp},   {"part", r.part},
                   {"batch", r.batch},   {"done", r.done}, {"allocated", json_of(r.allocated)}};
  return j;
}

RenderState state_from_json(const Json& j) {
  RenderState s;
  for (const Json& i : j.at("samples")) s.samples.add({i.at(0), i.at(1)});
  s.spp = j.at("spp");
  s.variance = {j.at("variance").at("squares"), j.at("variance").at("count")};
  RenderCounters::for_each(s.counters, s.counters, [&](const char* name, uint64_t& n, uint64_t&) {
    n = j.at("counters").at(name);
  });
  s.seconds = j.at("seconds");
  if (const auto r = j.find("rounds"); r != j.end())
    s.rounds = {r->at("length"), r->at("spp"),  r->at("part"),
                r->at("batch"),  r->at("done"), allocated_from(r->at("allocated"))};
  return s;
}

}  // namespace duet
