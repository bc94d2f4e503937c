// Volumes.
#include "mitsuba/plugins/plugin.h"
#include "mitsuba/plugins/tables.h"
#include "volume/volume_file.h"

namespace duet::plugins {

namespace {

void read_constvolume(SceneReader& s, Properties& p, MeantVolume& out) {
  p.transform("to_world");  // of interest to extinction_box() only
  const Property* value = p.find("value");
  if (const Triple* triple = value ? std::get_if<Triple>(&value->value) : nullptr) {
    out.value = to_spectrum(*triple);
    return;
  }
  out.value = s.color_volume(p, "value");
}

void read_gridvolume(SceneReader& s, Properties& p, MeantVolume& out) {
  VolumeDescription v;
  v.where = p.node().where;
  v.label = {p.node().id};
  read_values(s, p, v);
  const bool use_box = p.boolean("use_grid_bbox");
  const bool own_box = p.has("min") && p.has("max");
  VolumeGrid box;
  const Triple lower = p.triple("min"), upper = p.triple("max");
  for (size_t i = 0; i < 3 && own_box; ++i) {
    box.lower[i] = float(lower[i]), box.upper[i] = float(upper[i]);
    if (!(box.upper[i] > box.lower[i])) p.error("max", "the box from \"min\" to \"max\" is flat");
  }
  if (v.file.empty()) return;
  v.nodes = p.is_0x() || is_nanovdb(v.file) ? VolumeNodes::on_faces : VolumeNodes::within;
  v.grid = s.cache().volume_grid(v.file, p.where("filename"), v.is_float32);
  if (!v.grid) return;
  if (own_box)
    v.to_world = v.to_world * box_to_world(box);
  else if (p.is_0x() || use_box)
    v.to_world = v.to_world * box_to_world(*v.grid);
  out.value = s.add_volume(std::move(v));
}

void read_volcache(SceneReader& s, Properties& p, MeantVolume& out) {
  const Node* nested = p.child(PluginKind::volume);
  if (!nested) return p.needs("a volume");
  if (const auto value = s.volume(*nested, out.meaning)) out.value = *value;
}

constexpr Parameter kConstvolume[] = {
    {"value", coefficient, "1"},
    {"to_world", transform, "",
     "places the box that a heterogeneous medium of constant extinction fills in 3.x"}};
constexpr Parameter kBoxes[] = {
    {"use_grid_bbox", boolean, "false", "place the grid in the box of the file; 0.x always does",
     any, v3},
    {"min", point, "0 0 0", "with max: another box than the file's", any, v0},
    {"max", point, "1 1 1", "", any, v0}};

}  // namespace

std::vector<Plugin> volumes() {
  return {
      {"constvolume", both, kConstvolume, &read_constvolume},
      {"gridvolume",
       both,
       {parameters_of<VolumeDescription>(), kBoxes, inert_parameters(boolean, "raw accel", v3),
        inert_parameters(number, "max_value", v3), inert_parameters(boolean, "send_data", v0)},
       &read_gridvolume,
       "the grid \"density\" of .nvdb files, too"},
      refused_plugin("hgridvolume", v0, "grids of grids are not read",
                     "filename prefix postfix to_world"),
      {"volcache",
       v0,
       {inert_parameters(integer, "block_size"), inert_parameters(number, "voxel_width"),
        Parameter{
            .name = "memory_limit", .type = integer, .support = inert, .aliases = "cache_size"}},
       &read_volcache,
       "holds a volume"},
  };
}

}  // namespace duet::plugins
