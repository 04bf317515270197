#include "apps/command.h"

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <fmt/format.h>

#include <memory>

#include "apps/instruction_set.h"
#include "base/error.h"

namespace interstice::apps {
namespace {

std::unique_ptr<tbb::global_control> thread_limit;

bool is_ours(const std::filesystem::path& entry) {
  static const char* const names[] = {"scene.resolved.toml", "run.json",   "series.csv", "trajectory.h5part",
                                      "checkpoint.h5",       "fields",     "figures",    "comparison.csv",
                                      "summary.json",        "fields.vdb", "report.md"};
  const std::string name = entry.filename().string();
  for (const char* ours : names) {
    if (name == ours) return true;
  }
  return false;
}

}  // namespace

void add_compute_options(CLI::App& command, ComputeOptions& o) {
  command.add_option("--backend", o.backend,
                     "auto, cpu, cuda or reference (serial, neighbours by brute force)");
  command.add_option("--precision", o.precision,
                     "double, or mixed (positions double, forces and shares of voxels single)");
  command.add_option("--isa", o.isa,
                     "instruction set: auto (the richest of the programs here that runs on this machine), or "
                     "one of them such as x86-64-v3");
  command.add_option("--threads", o.threads, "number of threads (default: all cores)");
  command.add_flag("--json", o.json, "print the result as one JSON object");
  command.add_flag("--quiet", o.quiet, "no progress");
}

void apply_compute_options(const ComputeOptions& o) {
  std::vector<std::string> errors;
  if (o.backend == "cuda") {
    errors.emplace_back(
        "--backend: cuda is not in this build; allowed: auto, cpu, reference; leave the option out");
  } else if (o.backend != "auto" && o.backend != "cpu" && o.backend != "reference") {
    errors.push_back(fmt::format(
        "--backend: '{}' is unknown; allowed: auto, cpu, reference; leave the option out", o.backend));
  }
  if (o.precision != "double" && o.precision != "mixed") {
    errors.push_back(fmt::format("--precision: '{}' is unknown; allowed: double, mixed; leave the option out",
                                 o.precision));
  }
  try {
    run_on_instruction_set(o.isa);
  } catch (const InputError& e) {
    errors.insert(errors.end(), e.messages().begin(), e.messages().end());
  }
  if (o.threads < 0 || o.threads > 4096) {
    errors.push_back(
        fmt::format("--threads: {} is out of range; allowed: 1 to 4096, or 0 for all cores; use "
                    "--threads {}",
                    o.threads, tbb::info::default_concurrency()));
  }
  if (!errors.empty()) throw InputError(errors);
  if (o.threads > 0) {
    thread_limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                         static_cast<std::size_t>(o.threads));
  }
}

void prepare_output_folder(const std::filesystem::path& folder, bool overwrite) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error)) {
    throw InputError(folder.string() + ": is a file, not a folder; name another folder with -o");
  }
  if (fs::is_directory(folder, error) && !fs::is_empty(folder, error)) {
    if (!overwrite) {
      throw InputError(folder.string() +
                       ": holds results already; an empty or new folder is needed; use --resume to "
                       "continue, --overwrite to replace them, or another -o");
    }
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (is_ours(entry.path())) fs::remove_all(entry.path(), error);
    }
  }
  fs::create_directories(folder, error);
  if (error) throw RunError("cannot make the folder " + folder.string() + ": " + error.message());
}

}  // namespace interstice::apps
