// Which light a light sample is taken of, with what probability.
#pragma once

#include <memory>

#include "lights/light_selection.h"
#include "lights/light_tree.h"
#include "lights/picker.h"

namespace duet {

/// The numbers in [0, 1) of many light samples: what chooses the light, and the others.
struct LightVariates {
  const BatchArray<float>&u, &x, &y;
};

/// The lights that are chosen for many points.
struct LightChoices {
  BatchArray<uint32_t> light;
  BatchArray<float> probability;
};

/// Chooses the light of a light sample. Where a tree serves, a light at the point x has the
/// probability
///
///   P(l | x) = w_l                                   if it is infinitely far away,
///   P(l | x) = ε w_l + (1 − ε) W P_tree(l | x)       if it is somewhere,
///
/// with the normalised selection_weights() w, their sum W over the lights in the tree and ε =
/// kEvenShare, so that no light is forgotten whatever hides the others. Without a tree it is w_l.
class DirectPicker {
 public:
  static constexpr float kEvenShare = 0.1f;

  DirectPicker() = default;
  /// `factors` and `scene_radius` as for selection_weights(); the former multiply powers in the
  /// tree.
  DirectPicker(std::span<const std::unique_ptr<Light>> lights, std::span<const double> factors,
               double scene_radius, LightSelection selection);

  /// A light for the point `from`. There must be at least one. `others` as in fine_variate().
  LightPicker::Pick pick(float u, const Point2f& others, const Point3f& from) const {
    return tree_ ? pick_by_tree(u, others, from) : base_.pick(u, others);
  }
  /// The same for many points, with the same results bit for bit.
  void pick(int n, const LightVariates& numbers, const BatchTriples& from,
            LightChoices& choices) const;
  float probability(uint32_t light, const Point3f& from) const {
    const float p = base_.probability(light);
    return tree_ ? p * (1 - tree_share_) + tree_share_ * tree_->probability(light, from) : p;
  }
  size_t size() const { return base_.size(); }
  /// Null if the choice is the same everywhere.
  const LightTree* tree() const { return tree_.get(); }

 private:
  LightPicker::Pick pick_by_tree(float u, const Point2f& others, const Point3f& from) const;
  LightPicker::Pick of_tree(const LightTree::Pick& pick) const;
  /// What is left to `fine` above the share of the tree chooses evenly.
  LightPicker::Pick pick_evenly(double fine, const Point2f& others, const Point3f& from) const;
  void pick_by_tree(int n, const LightVariates& numbers, const BatchTriples& from,
                    LightChoices& choices) const;

  /// Beside a tree: of the choices that are not its own.
  LightPicker base_;
  std::unique_ptr<const LightTree> tree_;
  float tree_share_ = 0;  ///< of the choices
};

}  // namespace duet
