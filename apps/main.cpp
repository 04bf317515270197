// The `interstice` command: finds the subcommand, runs it, turns its errors into one line and an exit status.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>

#include "apps/command.h"
#include "apps/instruction_set.h"
#include "base/error.h"
#include "base/version.h"

namespace {

using namespace interstice;

int run(int argc, char** argv) {
  CLI::App root{
      "Interstice pours, spreads and compacts powder (DEM) and computes its void fraction (OpenVDB).",
      "interstice"};
  root.set_version_flag("--version",
                        fmt::format("interstice {} ({}), back ends: cpu, reference; built for {}", kVersion,
                                    kCommit, *kBuildArch ? kBuildArch : "any x86-64"));
  root.require_subcommand(1);
  root.fallthrough(false);
  apps::add_run(root);
  apps::add_voids(root);
  apps::add_batch(root);
  apps::add_compare(root);
  apps::add_check(root);
  apps::add_info(root);
  apps::add_bench(root);
  try {
    root.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return root.exit(e) == 0 ? apps::done : apps::bad_input;
  }
  return apps::done;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    apps::note_call(argv);
    return run(argc, argv);
  } catch (const apps::Exit& e) {
    return e.status;
  } catch (const InputError& e) {
    for (const std::string& line : e.messages()) fmt::print(stderr, "error: {}\n", line);
    return apps::bad_input;
  } catch (const UnstableError& e) {
    fmt::print(stderr, "error: unstable: {}\n", e.what());
    return apps::unstable;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "error: out of memory; use fewer grains, a larger voxel or a smaller box\n");
    return apps::failed;
  } catch (const std::exception& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return apps::failed;
  }
}
