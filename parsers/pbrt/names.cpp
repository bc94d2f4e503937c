// Materials, textures and media by name.
#include "pbrt/reader.h"
#include "values/text.h"

namespace duet::pbrt {

const NameTables& Reader::names() const {
  return version_ == Version::v3 ? *state_.names : global_names_;
}

NameTables& Reader::change_names() {
  if (version_ == Version::v4) return global_names_;
  // Other states on the stack keep what they have.
  if (state_.names.use_count() > 1) state_.names = std::make_shared<NameTables>(*state_.names);
  return *state_.names;
}

MaterialId Reader::named_material(const std::string& name, const SourceLocation& where) {
  const auto& known = names().materials;
  if (const auto found = known.find(name); found != known.end()) return found->second;
  const MaterialId id = add_material(NullMaterial{}, where);
  change_names().materials[name] = id;
  undefined_materials_.emplace(name, where);
  return id;
}

void Reader::define_material(const std::string& name, MaterialId made,
                             const SourceLocation& where) {
  const bool uses_uv = looks_at_uv_[size_t(made)];
  if (undefined_materials_.erase(name) > 0) {
    const MaterialId awaited = names().materials.at(name);
    scene_.materials[size_t(awaited)] = scene_.materials[size_t(made)];
    looks_at_uv_[size_t(awaited)] = uses_uv;
    if (const auto own = interiors_.find(made); own != interiors_.end())
      report_.error(where, "a material with a medium must be defined before it is used");
    return;
  }
  const auto [entry, is_new] = change_names().materials.insert_or_assign(name, made);
  (void)entry;
  if (!is_new && version_ == Version::v4)
    report_.error(where, "there is a material {} already", in_quotes(name));
}

MediumId Reader::named_medium(const std::string& name, const SourceLocation& where) {
  if (const auto found = media_.find(name); found != media_.end()) return found->second;
  const MediumId id{uint32_t(scene_.media.size())};
  scene_.media.emplace_back().where = where;
  media_[name] = id;
  undefined_media_.emplace(name, where);
  return id;
}

void Reader::define_medium(const std::string& name, MediumDescription medium) {
  const SourceLocation where = medium.where;
  if (undefined_media_.erase(name) > 0) {
    scene_.media[size_t(media_.at(name))] = std::move(medium);
    return;
  }
  if (media_.contains(name) && version_ == Version::v4)
    report_.error(where, "there is a medium {} already", in_quotes(name));
  media_[name] = MediumId(scene_.media.size());
  scene_.media.push_back(std::move(medium));
}

void Reader::check_names() {
  for (const auto& [name, where] : undefined_materials_) {
    auto known = report_.names_for_hint(names().materials);
    std::erase_if(known, [&](const std::string& k) { return undefined_materials_.contains(k); });
    report_.error(where, "there is no material {}{}", in_quotes(name), did_you_mean(name, known));
  }
  for (const auto& [name, where] : undefined_media_) {
    auto known = report_.names_for_hint(media_);
    std::erase_if(known, [&](const std::string& k) { return undefined_media_.contains(k); });
    report_.error(where, "there is no medium {}{}", in_quotes(name), did_you_mean(name, known));
  }
}

}  // namespace duet::pbrt
