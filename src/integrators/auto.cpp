#include "integrators/auto.h"

#include <sstream>
#include <stdexcept>

#include "integrators/make_integrator.h"
#include "integrators/method_choice.h"

namespace duet {

AutoIntegrator::AutoIntegrator(const AutoIntegratorDescription& options,
                               const IntegratorDescription& output)
    : options_(options), description_(output) {
  // All methods have the same channels.
  description_.method = PathIntegratorDescription{};
  chosen_ = make_integrator(description_);
}

void AutoIntegrator::choose(const Scene& scene, const RenderOutlook& outlook) {
  if (!decided_) {
    decided_ = true;
    const MethodChoice choice = choose_method(scene, options_, outlook);
    description_.method = choice.method;
    chosen_ = make_integrator(description_);
    decision_ = {integrator_name(description_), integrator_parameters(description_), choice.reason,
                 choice.candidates};
    decision_.bias = choice.bias;
    if (const auto* d = std::get_if<BidirectionalIntegratorDescription>(&choice.method))
      decision_.merge_parts = d->merge_parts;
  }
  chosen_->begin(scene, outlook);
}

void AutoIntegrator::adopt(const MethodDecision& decision) {
  IntegratorOverride chosen{decision.method, {}, {}};
  std::istringstream words(decision.parameters);
  for (std::string word; words >> word;) {
    const size_t equals = word.find('=');
    if (equals == word.npos) throw std::invalid_argument(word + " is no parameter");
    chosen.parameters.emplace_back(word.substr(0, equals), word.substr(equals + 1));
  }
  apply_override(description_, chosen);
  if (auto* d = std::get_if<BidirectionalIntegratorDescription>(&description_.method))
    d->merge_parts = decision.merge_parts;
  chosen_ = make_integrator(description_);
  decision_ = decision;
  decided_ = true;
}

void AutoIntegrator::prepare(Film& film) const {
  if (!decided_) throw std::logic_error("a method has to be chosen before there is a film");
  chosen_->prepare(film);
}

void AutoIntegrator::render_samples(const Scene& scene, Film& film, const SampleRange& samples,
                                    const PassControl& control, RenderCounters& counters) {
  chosen_->render_pass(scene, film, samples, control, counters);
}

}  // namespace duet
