// Media, phase functions and volumes as Mitsuba 3 writes them.
#include "mitsuba/scene_writer.h"

namespace duet {

void SceneWriter::volume(std::string_view name, VolumeId id) {
  const VolumeDescription& v = d_.volumes[size_t(id)];
  if (v.file.empty() && v.grid->node_count() == 1 && v.grid->channels != 6) {
    const std::vector<float>& c = v.grid->values;
    out_.open("volume", "constvolume", name);
    color("value", ColorInput(v.grid->channels == 1 ? Spectrum(c[0]) : Spectrum(c[0], c[1], c[2])));
    out_.transform("to_world", v.to_world);
    return out_.close();
  }
  constexpr std::string_view wraps[] = {"clamp", "repeat", "mirror"};
  out_.open("volume", "gridvolume", name);
  out_.string("filename", v.file);
  if (v.file.empty()) lose("a grid that does not come from a file is missing");
  if (!v.is_float32) lose("Mitsuba 3 reads only volume files with 32-bit floating-point numbers");
  if (v.nodes_on_faces)
    lose("the nodes of a grid lie half a cell inside its box, which nothing is cut off at");
  out_.transform("to_world", v.to_world);
  if (v.filter == VolumeFilter::nearest) out_.string("filter_type", "nearest");
  if (v.wrap != VolumeWrap::clamp) out_.string("wrap_mode", wraps[size_t(v.wrap)]);
  out_.close();
}

void SceneWriter::volume(std::string_view name, const ColorVolume& input) {
  if (const VolumeId* id = std::get_if<VolumeId>(&input)) return volume(name, *id);
  // Mitsuba 3 takes a plain <rgb> here for a reflectance, and refuses what is above 1.
  out_.open("volume", "constvolume", name);
  color("value", ColorInput(std::get<Spectrum>(input)));
  out_.close();
}

void SceneWriter::phase(PhaseId id) {
  const PhaseDescription& p = d_.phases[size_t(id)];
  constexpr std::string_view types[] = {"isotropic", "hg",   "rayleigh",
                                        "tabphase",  "sggx", "blendphase"};
  static_assert(std::size(types) == std::variant_size_v<decltype(p.model)>);
  out_.open("phase", types[p.model.index()]);
  if (const auto* hg = std::get_if<HenyeyGreensteinPhase>(&p.model)) {
    out_.number("g", hg->g);
  } else if (const auto* table = std::get_if<TabulatedPhase>(&p.model)) {
    std::string list;
    for (const double v : table->values) list += fmt::format("{}{}", list.empty() ? "" : ", ", v);
    out_.string("values", list);
  } else if (const auto* sggx = std::get_if<SggxPhase>(&p.model)) {
    if (const VolumeId* grid = std::get_if<VolumeId>(&sggx->matrix))
      volume("S", *grid);
    else
      lose("a constant matrix of \"sggx\" is missing");
  } else if (const auto* blend = std::get_if<BlendPhase>(&p.model)) {
    if (const VolumeId* grid = std::get_if<VolumeId>(&blend->weight))
      volume("weight", *grid);
    else
      out_.number("weight", std::get<double>(blend->weight));
    phase(blend->first);
    phase(blend->second);
  }
  out_.close();
}

void SceneWriter::medium(const MediumDescription& m, const std::string& id) {
  const bool grid = std::holds_alternative<VolumeId>(m.sigma_t);
  out_.open("medium", grid ? "heterogeneous" : "homogeneous", {}, id);
  volume("sigma_t", m.sigma_t);
  volume("albedo", m.albedo);
  out_.number("scale", m.scale);
  phase(m.phase);
  out_.close();
}

}  // namespace duet
