// Instantiates the loops for every listed combination in one number type.
#pragma once

#include <utility>

#include "dem/kernels/listed_laws.h"
#include "dem/kernels/pair_kernel.h"
#include "dem/kernels/wall_kernel.h"

namespace interstice::dem {

template <class L, class Real>
void pairs_entry(const Laws& chosen, const StepView& v, std::size_t begin, std::size_t end,
                 MemoryAhead ahead) {
  if constexpr (std::is_same_v<L, Laws>) {
    evaluate_groups<Laws, Real>(chosen, v, begin, end, ahead);
  } else {
    evaluate_groups<L, Real>(L{}, v, begin, end, ahead);
  }
}

template <class L, class Real>
void walls_entry(const Laws& chosen, const StepView& v, std::size_t begin, std::size_t end) {
  if constexpr (std::is_same_v<L, Laws>) {
    evaluate_walls<Laws, Real>(chosen, v, begin, end);
  } else {
    evaluate_walls<L, Real>(L{}, v, begin, end);
  }
}

template <class Real>
ForceKernels kernels_in(const Laws& laws, bool energies) {
  ForceKernels found{pairs_entry<Laws, Real>, walls_entry<Laws, Real>, true};
  if (energies) return found;
  const auto look = [&]<std::size_t I>() {
    if (!(kListedLaws[I] == laws)) return;
    using Fixed = FixedLaws<kListedLaws[I]>;
    found = {pairs_entry<Fixed, Real>, walls_entry<Fixed, Real>, false};
  };
  [&]<std::size_t... I>(std::index_sequence<I...>) { (look.template operator()<I>(), ...); }
  (std::make_index_sequence<kListedLaws.size()>());
  return found;
}

}  // namespace interstice::dem
