// Automatic choice of integrator.
#pragma once

#include <memory>

#include "integrators/integrator.h"
#include "scene/description_integrators.h"

namespace duet {

/// Decides in begin(), by the rules of method_rules.h and a pilot whose samples are not part of the
/// image (method_choice.h), and then is the method chosen. The decision depends on the scene, the
/// description, the size of the whole image and the samples per pixel, and on nothing else.
class AutoIntegrator final : public Integrator {
 public:
  /// `output` says what else to render; its own method is left out of account.
  AutoIntegrator(const AutoIntegratorDescription& options, const IntegratorDescription& output);

  /// Takes a decision that was made before for the same scene instead of making one. Throws
  /// std::invalid_argument if it is not one of Duet's.
  void adopt(const MethodDecision& decision);

  std::vector<std::string> channels() const override { return chosen_->channels(); }
  std::vector<std::string> data_channels() const override { return chosen_->data_channels(); }
  const MethodDecision* decision() const override { return decided_ ? &decision_ : nullptr; }
  std::string bias() const override { return decision_.bias; }
  bool blurs() const override { return chosen_->blurs(); }
  bool layers_tell_noise() const override { return chosen_->layers_tell_noise(); }
  uint32_t most_phases(Point2i film) const override { return chosen_->most_phases(film); }
  bool tiles_may_differ() const override { return chosen_->tiles_may_differ(); }
  double memory_bytes(const FilmLayout& film) const override { return chosen_->memory_bytes(film); }
  void prepare(Film& film) const override;

 private:
  void choose(const Scene& scene, const RenderOutlook& outlook) override;
  void render_samples(const Scene& scene, Film& film, const SampleRange& samples,
                      const PassControl& control, RenderCounters& counters) override;
  AutoIntegratorDescription options_;
  IntegratorDescription description_;   ///< with the method chosen
  std::unique_ptr<Integrator> chosen_;  ///< of the same channels before the decision
  bool decided_ = false;
  MethodDecision decision_;
};

}  // namespace duet
