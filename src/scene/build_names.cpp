// The names of what is built.
#include "scene/builder.h"
#include "scene/scene_names.h"

namespace duet {

void SceneBuilder::name_things(SceneNames& names) const {
  // In the order of shapes().
  const auto add_shapes = [&](const std::vector<ShapeDescription>& shapes) {
    for (const ShapeDescription& d : shapes)
      if (!std::holds_alternative<InstanceShape>(d.geometry)) names.shapes.push_back(d.label.text);
  };
  add_shapes(description_.shapes);
  for (const ShapeGroupDescription& g : description_.groups) add_shapes(g.shapes);
  for (const ShapeDescription& d : description_.shapes)
    if (std::holds_alternative<InstanceShape>(d.geometry)) names.instances.push_back(d.label.text);
  names.materials.resize(scene_->materials.size());
  for (size_t i = 0; i < materials_.size(); ++i)
    if (const uint32_t built = materials_[i].index; built != kNone)
      names.materials[built] = description_.materials[i].label.text;
}

void name_unnamed(SceneDescription& description) {
  size_t place = 0;
  const auto name_shapes = [&](std::vector<ShapeDescription>& shapes) {
    for (ShapeDescription& d : shapes) {
      if (d.label.text.empty() && !std::holds_alternative<InstanceShape>(d.geometry))
        d.label.text = fmt::format("shape#{}", place);
      ++place;
    }
  };
  name_shapes(description.shapes);
  for (ShapeGroupDescription& g : description.groups) name_shapes(g.shapes);
  for (size_t i = 0; i < description.materials.size(); ++i)
    if (std::string& name = description.materials[i].label.text; name.empty())
      name = fmt::format("material#{}", i);
}

}  // namespace duet
