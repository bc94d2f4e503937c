// A plugin as a value: what its struct says, together with what can be asked of any plugin of its
// kind. The set of plugins is open: whoever has a struct with a record has a plugin.
#pragma once

#include <memory>
#include <string>
#include <typeinfo>
#include <utility>

#include "scene/field_value.h"

namespace duet {

/// What a struct must have to be a plugin: its fields (field.h) and its name in Mitsuba 3.
template <class T>
concept PluginData = HasFields<T> && requires(const T& plugin) {
  std::string(plugin.name());
};

/// A plugin of one kind. `Operations` is what the kind is asked for beyond names and fields: a
/// struct of function pointers, made for a T by Operations::of<T>(). The value cannot be changed,
/// so that copies share it.
template <class Operations>
class Model {
 public:
  template <PluginData T>
  Model(T plugin) : record_(&kRecord<T>), plugin_(std::make_shared<const T>(std::move(plugin))) {}

  /// The name that Mitsuba 3 has, or would have, for the plugin with these values.
  std::string name() const { return record_->name(plugin_.get()); }
  void for_each_field(const FieldVisit& visit) const { record_->walk(plugin_.get(), visit); }
  const Operations& operations() const { return record_->operations; }
  /// What the operations are called with.
  const void* data() const { return plugin_.get(); }

  template <PluginData T>
  const T* get_if() const {
    return *record_->type == typeid(T) ? static_cast<const T*>(plugin_.get()) : nullptr;
  }
  template <PluginData T>
  bool is() const {
    return get_if<T>() != nullptr;
  }
  /// Throws std::bad_cast for another plugin.
  template <PluginData T>
  const T& get() const {
    if (const T* plugin = get_if<T>()) return *plugin;
    throw std::bad_cast();
  }

  friend bool operator==(const Model& a, const Model& b) {
    return *a.record_->type == *b.record_->type &&
           (a.plugin_ == b.plugin_ || a.record_->equal(a.plugin_.get(), b.plugin_.get()));
  }

 private:
  struct Record {
    const std::type_info* type;
    std::string (*name)(const void*);
    void (*walk)(const void*, const FieldVisit&);
    bool (*equal)(const void*, const void*);
    Operations operations;
  };
  template <class T>
  static constexpr Record kRecord{
      &typeid(T), [](const void* t) { return std::string(static_cast<const T*>(t)->name()); },
      [](const void* t, const FieldVisit& visit) {
        duet::for_each_field(
            *static_cast<const T*>(t),
            [&](const FieldFacts& facts, const auto& value) { visit(facts, field_value(value)); });
      },
      [](const void* a, const void* b) {
        return *static_cast<const T*>(a) == *static_cast<const T*>(b);
      },
      Operations::template of<T>()};

  const Record* record_;
  std::shared_ptr<const void> plugin_;
};

/// Calls visit(const FieldFacts&, value) with each field, as for a struct.
template <class Operations, class Visit>
void for_each_field(const Model<Operations>& model, Visit&& visit) {
  model.for_each_field([&](const FieldFacts& facts, const FieldValue& value) {
    with_value(value, [&](const auto& v) { visit(facts, v); });
  });
}

}  // namespace duet
