#include "mitsuba/read_fields.h"

#include "values/text.h"

namespace duet {

namespace {

bool is_index(const FieldFacts& facts) {
  return facts.parameters.front().type == ParameterType::ior;
}

Roughness unchecked_roughness(SceneReader& s, Properties& p) {
  constexpr std::string_view names[] = {"beckmann", "ggx", "ggx_correlated", "phong", "as"};
  Roughness r;
  const size_t name = p.choice("distribution", names);
  if (name < std::size(kMicrofacetNames))
    r.distribution = MicrofacetDistribution(name);
  else
    s.approximate_loudly(p.where("distribution"),
                         "the Phong microfacet distribution is approximated by Beckmann's");
  r.sample_visible = p.boolean("sample_visible");

  r.alpha_u = r.alpha_v = s.number_or_texture(p, "alpha");
  // Plastic is isotropic.
  if (!p.knows("alpha_u")) return r;
  const bool u = p.has("alpha_u"), v = p.has("alpha_v");
  if (u != v)
    p.error(u ? "alpha_u" : "alpha_v", "\"alpha_u\" and \"alpha_v\" must be given together");
  if (!u || !v) return r;
  if (p.has("alpha"))
    p.error("alpha_u", "either \"alpha\" or \"alpha_u\" and \"alpha_v\" can be given");
  r.alpha_u = s.number_or_texture(p, "alpha_u");
  r.alpha_v = s.number_or_texture(p, "alpha_v");
  return r;
}

}  // namespace

Roughness read_roughness(SceneReader& s, Properties& p) {
  // A roughness of zero or less has no distribution; Mitsuba uses a small one then.
  constexpr double least = 1e-4;
  Roughness r = unchecked_roughness(s, p);
  for (FloatInput* alpha : {&r.alpha_u, &r.alpha_v})
    if (double* value = std::get_if<double>(alpha)) {
      if (*value < 0)
        p.error(p.has("alpha") ? "alpha" : "alpha_u", "a roughness must not be negative");
      *value = std::max(*value, least);
    }
  return r;
}

double relative_index(SceneReader& s, Properties& p) {
  const double inside = s.index_of_refraction(p, "int_ior");
  const double outside = s.index_of_refraction(p, "ext_ior");
  if (p.node().type.starts_with("rough") && inside == outside)
    p.error("int_ior", "the indices of refraction of {} must differ", describe(p.node()));
  return inside / outside;
}

namespace {

/// What `read` makes of each of them; none after an error.
template <class Read>
auto read_all(const std::vector<Properties::Child>& children, Read read) {
  std::vector<typename std::invoke_result_t<Read, const Node&>::value_type> ids;
  for (const Properties::Child& child : children)
    if (const auto id = read(*child.node)) ids.push_back(*id);
  if (ids.size() != children.size()) ids.clear();
  return ids;
}

}  // namespace

std::vector<MaterialId> nested_bsdfs(SceneReader& s, Properties& p, size_t least, size_t most) {
  const auto children = p.children(PluginKind::bsdf);
  if (children.size() >= least && children.size() <= most)
    return read_all(children, [&](const Node& node) { return s.material(node); });
  p.needs("{}{} nested BSDF{}, not {}", least, least == most ? "" : " or " + std::to_string(most),
          most == 1 ? "" : "s", children.size());
  return {};
}

std::vector<PhaseId> nested_phases(SceneReader& s, Properties& p, size_t count) {
  const auto children = p.children(PluginKind::phase);
  if (children.size() == count)
    return read_all(children, [&](const Node& node) { return s.phase(node); });
  p.needs("{} phase functions, not {}", count, children.size());
  return {};
}

void FieldReader::read(const FieldFacts& facts, double& value) {
  if (is_index(facts))
    value = relative_index(s_, p_);
  else  // a default in words is what the value begins with
    value = p_.optional_number(facts.name())
                .value_or(parse_number(p_.preset(facts.name())).value_or(value));
}

void FieldReader::read(const FieldFacts& facts, std::string& value) {
  value = facts.parameters.front().type == ParameterType::file ? s_.file(p_, facts.name())
                                                               : p_.string(facts.name());
}

void FieldReader::read(const FieldFacts& facts, std::optional<ColorInput>& value) {
  if (p_.has(facts.name())) value = s_.color(p_, facts.name());
}

void FieldReader::read(const FieldFacts& facts, FloatInput& value) {
  if (is_index(facts))
    value = relative_index(s_, p_);
  else
    value = s_.number_or_texture(p_, facts.name());
}

void FieldReader::read(const FieldFacts& facts, UvTransform& value) {
  if (facts.has_parameter("to_uv") && p_.has("to_uv")) {
    const Matrix4 m = p_.transform("to_uv");
    for (int i = 0; i < 2; ++i) value.m[i] = {m[i][0], m[i][1], m[i][3]};
    for (const char* name : {"uoffset", "voffset", "uscale", "vscale", "uvscale"})
      if (p_.has(name)) p_.error(name, "both \"to_uv\" and {} are given", in_quotes(name));
    return;
  }
  const double scale = p_.number("uvscale");
  value.m[0] = {p_.optional_number("uscale").value_or(scale), 0, p_.number("uoffset")};
  value.m[1] = {0, p_.optional_number("vscale").value_or(scale), p_.number("voffset")};
}

void FieldReader::read_nested(TextureId& value) {
  const Node* node = p_.child(PluginKind::texture);
  if (!node) p_.needs("a texture");
  const auto id = node ? s_.texture(*node) : std::nullopt;
  if (id) value = *id;
  complete_ = complete_ && id;
}

void FieldReader::read(const FieldFacts&, std::optional<Roughness>& value) {
  if (p_.knows("alpha")) value = read_roughness(s_, p_);
}

}  // namespace duet
