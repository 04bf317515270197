// The kernels of one number type each; every number type is a translation unit of its own.
#pragma once

#include "dem/kernels/kernels.h"

namespace interstice::dem {

ForceKernels kernels_in_double(const Laws& laws, bool energies);
ForceKernels kernels_in_single(const Laws& laws, bool energies);

}  // namespace interstice::dem
