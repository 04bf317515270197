// The options that `voids` and `batch` share, as the command line names them.
#pragma once

#include "apps/voids_options.h"

namespace interstice::apps {

void add_voids_flags(CLI::App& command, VoidsWords& words);

}  // namespace interstice::apps
