#include "coupling/stream/run_figures.h"
