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
    share_interior(made, awaited);
    return;
  }
  const auto [entry, is_new] = change_names().materials.insert_or_assign(name, made);
  (void)entry;
  if (!is_new && version_ == Version::v4)
    report_.error(where, "there is a material {} already", in_quotes(name));
}

bool Reader::is_awaited(MaterialId material) const {
  for (const auto& [name, where] : undefined_materials_)
    if (names().materials.at(name) == material) return true;
  return false;
}

namespace {

/// What the tables of names have for colours and for numbers.
auto& texture_names(NameTables& names, const ColorInput*) {
  return names.colors;
}
auto& texture_names(NameTables& names, const FloatInput*) {
  return names.numbers;
}

/// The same everywhere.
BilerpDescription constant_texture(const Spectrum& c) {
  return {c, c, c, c, {}};
}
BilerpDescription constant_texture(double x) {
  return constant_texture(Spectrum(float(x)));
}

}  // namespace

template <class Input>
const Input& Reader::await_texture(const std::string& name, const SourceLocation& where,
                                   bool by_texture) {
  constexpr bool is_color = std::is_same_v<Input, ColorInput>;
  (is_color ? undefined_colors_ : undefined_numbers_).emplace(name, where);
  if (by_texture) awaited_images_.emplace(name, where);
  Input& entry = texture_names(change_names(), static_cast<const Input*>(nullptr))[name];
  entry = add_texture(constant_texture(0.5), where);
  return entry;
}

template <class Input>
void Reader::define_texture(const std::string& name, const Input& made, bool is_image,
                            const SourceLocation& where) {
  constexpr bool is_color = std::is_same_v<Input, ColorInput>;
  auto& known = texture_names(change_names(), static_cast<const Input*>(nullptr));
  if ((is_color ? undefined_colors_ : undefined_numbers_).erase(name) > 0) {
    if (const auto user = awaited_images_.extract(name); user && !is_image)
      report_.error(user.mapped(),
                    "texture {} is defined only after this one: of textures, only images may be",
                    in_quotes(name));
    const TextureId awaited = std::get<TextureId>(known.at(name));
    if (const TextureId* id = std::get_if<TextureId>(&made))
      scene_.textures[size_t(awaited)] = scene_.textures[size_t(*id)];
    else
      scene_.textures[size_t(awaited)].model = constant_texture(std::get<0>(made));
    // Who comes later gets the texture itself.
    known.at(name) = made;
    return;
  }
  const bool is_new = known.insert_or_assign(name, made).second;
  if (!is_new && version_ == Version::v4)
    report_.error(where, "there is a texture {} already", in_quotes(name));
}

template const ColorInput& Reader::await_texture(const std::string&, const SourceLocation&, bool);
template const FloatInput& Reader::await_texture(const std::string&, const SourceLocation&, bool);
template void Reader::define_texture(const std::string&, const ColorInput&, bool,
                                     const SourceLocation&);
template void Reader::define_texture(const std::string&, const FloatInput&, bool,
                                     const SourceLocation&);

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
  const auto check = [&](const Undefined& undefined, const auto& all, const char* what,
                         const char* of) {
    for (const auto& [name, where] : undefined) {
      auto known = report_.names_for_hint(all);
      std::erase_if(known, [&](const std::string& k) { return undefined.contains(k); });
      report_.error(where, "there is no {} {}{}{}", what, in_quotes(name), of,
                    did_you_mean(name, known));
    }
  };
  check(undefined_materials_, names().materials, "material", "");
  check(undefined_media_, media_, "medium", "");
  check(undefined_colors_, names().colors, "texture", " of colours");
  check(undefined_numbers_, names().numbers, "texture", " of numbers");
  finish_shapes();
}

}  // namespace duet::pbrt
