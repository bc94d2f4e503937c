// Directives that change the current transform.
#include <cmath>

#include "pbrt/directives.h"
#include "values/text.h"

namespace duet::pbrt {

void Directives::apply(const Matrix4& m) {
  for (unsigned i = 0; i < 2; ++i)
    if (state().active & (1u << i)) state().ctm[i] = state().ctm[i] * m;
}

void Directives::identity(Lexer&, const Plugin&) {
  for (unsigned i = 0; i < 2; ++i)
    if (state().active & (1u << i)) state().ctm[i] = {};
}

void Directives::translate(Lexer& in, const Plugin& d) {
  const auto n = take_numbers(in, 3, d);
  apply(Matrix4::translate(n[0], n[1], n[2]));
}

void Directives::scale(Lexer& in, const Plugin& d) {
  const auto n = take_numbers(in, 3, d);
  if (n[0] == 0 || n[1] == 0 || n[2] == 0) {
    report().error(d.where, "a scale of zero flattens space");
    return;
  }
  apply(Matrix4::scale(n[0], n[1], n[2]));
}

void Directives::rotate(Lexer& in, const Plugin& d) {
  const auto n = take_numbers(in, 4, d);
  if (n[1] == 0 && n[2] == 0 && n[3] == 0) {
    report().error(d.where, "a rotation needs an axis");
    return;
  }
  apply(Matrix4::rotate(n[0], n[1], n[2], n[3]));
}

void Directives::look_at(Lexer& in, const Plugin& d) {
  const auto n = take_numbers(in, 9, d);
  const auto to_world =
      Matrix4::look_at({n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]});
  if (!to_world || !to_world->inverse()) {
    report().error(d.where, "LookAt: the eye, the point looked at and up lie on one line");
    return;
  }
  apply(*to_world->inverse());
}

Matrix4 Directives::take_matrix(Lexer& in, const Plugin& d) {
  const auto n = take_numbers(in, 16, d);
  Matrix4 m;
  // Column by column.
  for (int i = 0; i < 4; ++i)
    for (size_t j = 0; j < 4; ++j) m[i][j] = n[j * 4 + size_t(i)];
  // Other programs write matrices of single precision.
  constexpr double kRounding = 1e-6;
  if (m.is_affine(kRounding)) m[3] = {0, 0, 0, 1};
  if (m.is_affine() && m.inverse()) return m;
  report().error(d.where, "the matrix is not affine, or flattens space");
  return {};
}

void Directives::transform(Lexer& in, const Plugin& d) {
  const Matrix4 m = take_matrix(in, d);
  for (unsigned i = 0; i < 2; ++i)
    if (state().active & (1u << i)) state().ctm[i] = m;
}

void Directives::concat_transform(Lexer& in, const Plugin& d) {
  apply(take_matrix(in, d));
}

void Directives::coordinate_system(Lexer& in, const Plugin& d) {
  coordinate_systems_[take_string(in, d)] = state().ctm;
}

void Directives::coord_sys_transform(Lexer& in, const Plugin& d) {
  const std::string name = take_string(in, d);
  const auto found = coordinate_systems_.find(name);
  if (found == coordinate_systems_.end()) {
    report().warning(d.where, "there is no coordinate system {}; nothing changes, as in pbrt{}",
                     in_quotes(name),
                     did_you_mean(name, report().names_for_hint(coordinate_systems_)));
    return;
  }
  state().ctm = found->second;
}

void Directives::active_transform(Lexer& in, const Plugin& d) {
  const std::string which = in.peek() == Kind::word ? in.take_word() : "";
  if (which == "All")
    state().active = 3;
  else if (which == "StartTime")
    state().active = 1;
  else if (which == "EndTime")
    state().active = 2;
  else
    report().error(d.where, "ActiveTransform is All, StartTime or EndTime");
}

void Directives::transform_times(Lexer& in, const Plugin& d) {
  const auto n = take_numbers(in, 2, d);
  if (n[0] < n[1])
    reader_.transform_times = {n[0], n[1]};
  else
    report().error(d.where, "the second time must be later than the first");
}

}  // namespace duet::pbrt
