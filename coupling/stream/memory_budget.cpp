#include "coupling/stream/memory_budget.h"

#include <unistd.h>

#include <fstream>
#include <string>

namespace interstice::stream {

double available_memory() {
  std::ifstream in("/proc/meminfo");
  for (std::string key; in >> key;) {
    double kibibytes = 0;
    if (key == "MemAvailable:" && in >> kibibytes && kibibytes > 0) return 1024 * kibibytes;
    std::getline(in, key);
  }
  return 0.5 * static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

}  // namespace interstice::stream
