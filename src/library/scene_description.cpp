#include "duet/scene_description.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "math/transform.h"
#include "mitsuba/mitsuba.h"

namespace duet {

namespace {

std::array<double, 3> triple(const ScenePoint& p) {
  return {p.x, p.y, p.z};
}

}  // namespace

SceneTransform SceneTransform::translate(const ScenePoint& by) {
  return {Matrix4::translate(by.x, by.y, by.z).m};
}

SceneTransform SceneTransform::scale(const ScenePoint& by) {
  return {Matrix4::scale(by.x, by.y, by.z).m};
}

SceneTransform SceneTransform::rotate(double degrees, const ScenePoint& axis) {
  return {Matrix4::rotate(degrees, axis.x, axis.y, axis.z).m};
}

SceneTransform SceneTransform::look_at(const ScenePoint& origin, const ScenePoint& target,
                                       const ScenePoint& up) {
  const auto matrix = Matrix4::look_at(triple(origin), triple(target), triple(up));
  if (!matrix)
    throw std::invalid_argument("look_at: the target is the origin, or up is parallel to the view");
  return {matrix->m};
}

SceneTransform SceneTransform::operator*(const SceneTransform& first) const {
  return {(Matrix4{rows} * Matrix4{first.rows}).m};
}

SceneObject::SceneObject(std::string kind, std::string type, std::string id)
    : kind_(std::move(kind)), type_(std::move(type)), id_(std::move(id)) {}

SceneObject SceneObject::scene() {
  return {"scene", "scene"};
}

SceneObject SceneObject::mesh(SceneMesh triangles, std::string id) {
  SceneObject shape("shape", "ply", std::move(id));
  shape.triangles_ = std::make_shared<const SceneMesh>(std::move(triangles));
  return shape;
}

SceneObject& SceneObject::set(std::string name, SceneValue value) {
  entries_.push_back({std::move(name), std::move(value)});
  return *this;
}

SceneObject& SceneObject::add(SceneObject object, std::string name) {
  // Of the reader's levels the last one is that of parameters.
  if (object.depth_ >= kDeepestNesting)
    throw std::invalid_argument(
        fmt::format("objects are nested more than {} deep", kDeepestNesting));
  depth_ = std::max(depth_, object.depth_ + 1);
  entries_.push_back({std::move(name), std::move(object)});
  return *this;
}

SceneObject& SceneObject::add(SceneReference object, std::string name) {
  return set(std::move(name), std::move(object));
}

}  // namespace duet
