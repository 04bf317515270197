// interstice run SCENE.toml -o DIR
#include <fmt/format.h>
#include <tbb/info.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/progress.h"
#include "base/error.h"
#include "base/version.h"
#include "coupling/scene/read_scene.h"
#include "coupling/scene/units.h"
#include "coupling/stream/build_model.h"
#include "coupling/stream/contact_report.h"
#include "coupling/stream/field_memory.h"
#include "coupling/stream/memory_budget.h"
#include "coupling/stream/run.h"
#include "coupling/stream/run_report.h"

namespace interstice::apps {
namespace {

std::atomic<bool> stop_flag{false};

struct RunArguments {
  std::string scene, folder, until, time_limit;
  std::vector<std::string> overrides;
  bool resume = false, overwrite = false, no_figures = false;
  ComputeOptions compute;
};

void stop_on_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) std::signal(signal, [](int) { stop_flag = true; });
}

void print_summary(const stream::RunResult& r, const std::string& folder) {
  fmt::print("{} at t = {:.6g} s after {} steps: {} grains ({} inserted, {} lost)\n",
             r.finished ? "Finished" : "Stopped (" + r.exit_reason + ")", r.time, r.steps, r.grains,
             r.grains_inserted, r.grains_lost);
  for (const auto& p : r.phases) {
    fmt::print("  phase {:<10} {:.6g} s to {:.6g} s ({})\n", p.name, p.start, p.end,
               p.ended_by.empty() ? "open" : p.ended_by);
  }
  fmt::print(
      "{:.1f} s of wall time, {:.3g} million particle-steps/s; waited for fields {:.1f} %, files {:.1f} %\n",
      r.wall_seconds, r.step_seconds > 0 ? r.particle_steps / r.step_seconds / 1e6 : 0,
      100 * r.field_wait_seconds / std::max(r.wall_seconds, 1e-9),
      100 * r.file_seconds / std::max(r.wall_seconds, 1e-9));
  fmt::print("Results in {}\n", folder);
}

void run(const RunArguments& a) {
  apply_compute_options(a.compute);
  stream::RunOptions options;
  if (!a.until.empty()) options.until = scene::parse_quantity(a.until, scene::Dimension::time, "--until");
  if (!a.time_limit.empty()) {
    options.time_limit = scene::parse_quantity(a.time_limit, scene::Dimension::time, "--time-limit");
  }
  std::vector<std::string> warnings;
  const scene::Scene scene = scene::read_scene(a.scene, a.overrides, &warnings);
  const dem::Model model = stream::build_model(scene);
  const stream::StepChoice choice = stream::choose_step(scene, model);  // refuse before anything is written
  stream::report_contacts(scene, model, choice.speed, choice.step);
  stream::check_fields_memory(scene, stream::available_memory());
  if (a.resume) {
    if (!std::filesystem::exists(std::filesystem::path(a.folder) / "checkpoint.h5")) {
      throw InputError(a.folder +
                       ": holds no checkpoint.h5; --resume continues a run that left one; run without "
                       "--resume");
    }
  } else {
    prepare_output_folder(a.folder, a.overwrite);
  }
  ProgressBar bar(a.compute.quiet);
  options.folder = a.folder;
  options.resume = a.resume;
  options.reference = a.compute.backend == "reference";
  options.backend = options.reference ? "reference" : "cpu";
  options.mixed = a.compute.precision == "mixed";
  options.precision = a.compute.precision;
  options.isa = kBuildArch;
  options.figures = !a.no_figures;
  options.threads = options.reference       ? 1
                    : a.compute.threads > 0 ? a.compute.threads
                                            : tbb::info::default_concurrency();
  options.stop = &stop_flag;
  options.progress = [&](const stream::Progress& p) { bar.show(p); };
  options.warn = [&](const std::string& text) { bar.line("warning: " + text); };
  for (const std::string& w : warnings) options.warn(w);
  stop_on_signals();
  const stream::RunResult result = stream::run_scene(scene, options);
  bar.clear();
  if (a.compute.json) {
    fmt::print("{}\n", stream::run_report(scene, options, choice, result).dump(2));
  } else {
    print_summary(result, a.folder);
  }
  if (!result.finished) throw Exit{stopped_early};
}

}  // namespace

void add_run(CLI::App& root) {
  auto a = std::make_shared<RunArguments>();
  CLI::App* c = root.add_subcommand("run", "run a scene: pour, spread, compact, with fields on the way");
  c->add_option("scene", a->scene, "scene file (TOML)")->required();
  c->add_option("-o,--output", a->folder, "folder for the results")->required();
  c->add_option("--set", a->overrides, "override: path.to.key=value (repeatable)")->allow_extra_args(false);
  c->add_flag("--resume", a->resume, "continue from the folder's checkpoint");
  c->add_flag("--overwrite", a->overwrite, "replace earlier results in the folder");
  c->add_option("--until", a->until, "stop at this simulated time, e.g. 20ms (resumable)");
  c->add_option("--time-limit", a->time_limit, "stop after this wall-clock time, e.g. 2h (resumable)");
  c->add_flag("--no-figures", a->no_figures, "draw no figures");
  add_compute_options(*c, a->compute);
  c->callback([a] { run(*a); });
}

}  // namespace interstice::apps
