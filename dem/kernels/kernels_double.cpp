#include "dem/kernels/kernel_table.h"
#include "dem/kernels/kernels_by_precision.h"

namespace interstice::dem {

ForceKernels kernels_in_double(const Laws& laws, bool energies) { return kernels_in<double>(laws, energies); }

}  // namespace interstice::dem
