// Scenes that a program puts together: a tree of the format's objects, by the names that
// `duet plugins` and docs/compatibility.md list, which SceneFile::from_description() makes a scene
// of.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace duet {

/// A linear colour in the primaries of sRGB.
struct SceneRgb {
  double r = 0, g = 0, b = 0;
};

/// A point or a vector, in the unit of the scene's lengths.
struct ScenePoint {
  double x = 0, y = 0, z = 0;
};

/// Takes column vectors from an object's own space to where it is: row by row.
struct [[gnu::visibility("default")]] SceneTransform {
  std::array<std::array<double, 4>, 4> rows{
      {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

  static SceneTransform translate(const ScenePoint& by);
  static SceneTransform scale(const ScenePoint& by);
  /// About an axis of any length; the identity for one of no length.
  static SceneTransform rotate(double degrees, const ScenePoint& axis);
  /// Of a sensor or light at `origin`, with `up` upwards. Throws std::invalid_argument if the
  /// target is the origin or `up` is parallel to the view.
  static SceneTransform look_at(const ScenePoint& origin, const ScenePoint& target,
                                const ScenePoint& up);
  /// The right one first.
  SceneTransform operator*(const SceneTransform& first) const;
};

/// Names the object that has this id, wherever it is in the scene.
struct SceneReference {
  std::string id;
};

/// The value of a parameter. Whole numbers stand for real ones, too; texts are as they are, without
/// `$name` parameters.
using SceneValue = std::variant<bool, int64_t, double, std::string, SceneRgb, ScenePoint,
                                SceneTransform, SceneReference>;

/// Triangles.
struct SceneMesh {
  std::vector<std::array<float, 3>> positions;  ///< in the unit of the scene's lengths
  /// Three positions each, counted from 0, counter-clockwise as seen from the front.
  std::vector<std::array<uint32_t, 3>> triangles;
  /// One for each position, of any length, or none: then the surface is smooth, unless the
  /// parameter "face_normals" is true.
  std::vector<std::array<float, 3>> normals = {};
  std::vector<std::array<float, 2>> uvs = {};  ///< one for each position, or none
};

/// An object of a scene with its parameters and the objects in it. Copies are independent.
class [[gnu::visibility("default")]] SceneObject {
 public:
  struct Entry;
  /// `kind` is "integrator", "sensor", "shape", "bsdf" …, and `type` the plugin: "path",
  /// "perspective", "sphere", "diffuse" … References can name it if it has an id. What there is not
  /// is an error of SceneFile::from_description().
  SceneObject(std::string kind, std::string type, std::string id = "");
  /// The outermost object, empty.
  static SceneObject scene();
  /// A shape of the type "ply" with these triangles instead of a file.
  static SceneObject mesh(SceneMesh triangles, std::string id = "");

  /// Gives a parameter its value; twice is an error of from_description().
  SceneObject& set(std::string name, SceneValue value);
  /// Puts a copy of an object into this one, which may need a name for it: "reflectance" for a
  /// texture, "interior" for a medium. Throws std::invalid_argument if objects are nested more than
  /// 64 deep.
  SceneObject& add(SceneObject object, std::string name = "");
  /// The same with an object that stands elsewhere in the scene.
  SceneObject& add(SceneReference object, std::string name = "");

  const std::string& kind() const {
    return kind_;
  }
  const std::string& type() const {
    return type_;
  }
  const std::string& id() const {
    return id_;
  }
  /// In the order in which they were given.
  const std::vector<Entry>& entries() const {
    return entries_;
  }
  /// Of mesh(); null of others.
  const std::shared_ptr<const SceneMesh>& triangles() const {
    return triangles_;
  }

 private:
  std::string kind_, type_, id_;
  std::vector<Entry> entries_;
  std::shared_ptr<const SceneMesh> triangles_;
  int depth_ = 1;  ///< of the objects from this one on
};

/// A parameter or an object within another one.
struct SceneObject::Entry {
  std::string name;  ///< "" if it has none
  std::variant<SceneValue, SceneObject> value;
};

}  // namespace duet
