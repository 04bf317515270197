#include "dem/kernels/kernels.h"

#include <algorithm>

#include "dem/kernels/kernels_by_precision.h"
#include "dem/kernels/listed_laws.h"

namespace interstice::dem {

ForceKernels find_kernels(const Laws& laws, Precision precision, bool energies) {
  return precision == Precision::mixed ? kernels_in_single(laws, energies)
                                       : kernels_in_double(laws, energies);
}

bool has_own_kernel(const Laws& laws) {
  return std::find(kListedLaws.begin(), kListedLaws.end(), laws) != kListedLaws.end();
}

}  // namespace interstice::dem
