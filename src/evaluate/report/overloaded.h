// A function of one alternative of a variant, put together from lambdas.
#pragma once

namespace duet {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

}  // namespace duet
