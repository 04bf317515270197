// What the subcommands share: each registers itself on the root and does its work in its CLI11 callback,
// throwing typed errors that main() turns into exit statuses.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

namespace interstice::apps {

enum ExitStatus { done = 0, failed = 1, bad_input = 2, unstable = 3, stopped_early = 75 };

/// Thrown by a command that ends with a status of its own after having said why.
struct Exit {
  int status;
};

/// Options that every computing subcommand takes.
struct ComputeOptions {
  std::string backend = "auto";
  std::string precision = "double";
  std::string isa = "auto";
  int threads = 0;  // 0: all
  bool json = false;
  bool quiet = false;
};
void add_compute_options(CLI::App& command, ComputeOptions& options);

/// Checks what this build cannot do (throws InputError), sets the number of threads for the process.
void apply_compute_options(const ComputeOptions& options);

/// A folder for results: made if missing; refused (InputError) when not empty, unless `overwrite` clears what
/// an earlier run of this tool left there.
void prepare_output_folder(const std::filesystem::path& folder, bool overwrite);

void add_run(CLI::App& root);
void add_voids(CLI::App& root);
void add_batch(CLI::App& root);
void add_compare(CLI::App& root);
void add_check(CLI::App& root);
void add_info(CLI::App& root);
void add_bench(CLI::App& root);

}  // namespace interstice::apps
