#include "integrators/auto.h"

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
  if (decided_) return;
  decided_ = true;
  const MethodChoice choice = choose_method(scene, options_, outlook);
  description_.method = choice.method;
  chosen_ = make_integrator(description_);
  decision_ = {integrator_name(description_), integrator_parameters(description_), choice.reason,
               choice.candidates};
  bias_ = choice.bias;
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
