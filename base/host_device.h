// The one place that knows whether a function may run on a GPU.
#pragma once

#if defined(__CUDACC__)
#define INTERSTICE_HD __host__ __device__
#else
#define INTERSTICE_HD
#endif
