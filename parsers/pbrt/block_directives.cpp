// Directives that begin and end blocks.
#include "pbrt/directives.h"

namespace duet::pbrt {

namespace {

/// Blocks within blocks.
constexpr size_t kMostBlocks = 100000;

}  // namespace

void Directives::push(Begun what, const SourceLocation& where) {
  if (saved_.size() >= kMostBlocks) throw SyntaxError{where, "too many blocks within blocks"};
  saved_.push_back({what, where, state()});
}

void Directives::pop(Begun what, const Plugin& d) {
  if (saved_.empty()) {
    if (what == Begun::object) throw SyntaxError{d.where, d.directive + " without its beginning"};
    report().warning(d.where, "{} without its beginning; it is ignored, as in pbrt", d.directive);
    return;
  }
  const Saved& last = saved_.back();
  // v4 has one kind of block under two names.
  const bool is_alike =
      reader_.version() == Version::v4 && what != Begun::object && last.what != Begun::object;
  if (last.what != what && !is_alike)
    report().error(d.where, "{} does not end what began at {}", d.directive,
                   last.where.to_string());
  if (what == Begun::transform && reader_.version() == Version::v3)
    state().ctm = last.state.ctm, state().active = last.state.active;
  else
    state() = last.state;
  saved_.pop_back();
}

void Directives::attribute_begin(Lexer&, const Plugin& d) {
  push(Begun::attribute, d.where);
}

void Directives::attribute_end(Lexer&, const Plugin& d) {
  pop(Begun::attribute, d);
}

void Directives::transform_begin(Lexer&, const Plugin& d) {
  push(Begun::transform, d.where);
}

void Directives::transform_end(Lexer&, const Plugin& d) {
  pop(Begun::transform, d);
}

void Directives::object_begin(Lexer& in, const Plugin& d) {
  const std::string name = take_string(in, d);
  push(Begun::object, d.where);
  reader_.begin_object(name, d.where);
}

void Directives::object_end(Lexer&, const Plugin& d) {
  pop(Begun::object, d);
  reader_.end_object(d.where);
}

void Directives::object_instance(Lexer& in, const Plugin& d) {
  reader_.add_instance(take_string(in, d), d.where);
}

void Directives::world_begin(Lexer&, const Plugin&) {
  if (in_world_) return;  // after an error
  in_world_ = true;
  coordinate_systems_["world"] = {};
  state().ctm = {};
  state().active = 3;
}

void Directives::world_end(Lexer&, const Plugin& d) {
  if (reader_.version() == Version::v4)
    report().error(
        d.where,
        "WorldEnd is pbrt-v3's, and this file is read as pbrt-v4 (--pbrt-version 3 reads "
        "it otherwise)");
}

}  // namespace duet::pbrt
