// interstice batch INPUT... -o DIR: `voids` over many files and frames, on all cores.
#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <memory>
#include <set>

#include "apps/progress.h"
#include "apps/voids_flags.h"
#include "apps/voids_output.h"
#include "base/error.h"
#include "base/version.h"
#include "coupling/figures/figures.h"
#include "coupling/io/vti_file.h"
#include "coupling/stream/frame_queue.h"
#include "coupling/stream/memory_budget.h"
#include "coupling/studies/batch_folder.h"

namespace interstice::apps {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

std::atomic<bool> stop_flag{false};

/// All options that change what is computed or written, as typed: a batch goes on under the same ones only.
Json options_of(const CLI::App& command) {
  static const std::set<std::string> others{"inputs",    "--output", "--help", "--overwrite",
                                            "--threads", "--quiet",  "--json", "--memory"};
  Json options = Json::object();
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() > 0 && others.count(option->get_name()) == 0)
      options[option->get_name()] = option->results();
  }
  return options;
}

class Batch {
 public:
  Batch(const VoidsOptions& options, const ComputeOptions& compute, studies::BatchFolder& folder)
      : options_(options),
        compute_(compute),
        folder_(folder),
        budget_(options.memory > 0 ? options.memory : 0.6 * stream::available_memory()),
        bar_(compute.quiet) {}

  /// Returns the exit status.
  int run() {
    begin_ = Clock::now();
    stream::FrameQueue queue(look_through(), options_.reader);
    skipped_ = folder_.finished();
    const int workers = tbb::this_task_arena::max_concurrency();
    // A worker waits for a frame's inner loops only, and never takes another frame on top of it.
    tbb::parallel_for(
        tbb::blocked_range<int>(0, workers, 1),
        [&](const tbb::blocked_range<int>&) {
          while (auto item = queue.next()) {
            tbb::this_task_arena::isolate([&] { work(*item, queue); });
          }
        },
        tbb::simple_partitioner());
    const auto warnings = queue.take_warnings();
    for (const auto& line : std::set<std::string>(warnings.begin(), warnings.end())) {
      bar_.line("warning: " + line);
    }
    std::sort(failures_.begin(), failures_.end(), [](const auto& a, const auto& b) {
      return std::pair(a.input, a.frame) < std::pair(b.input, b.frame);
    });
    folder_.close(failures_);
    draw_over_time();
    bar_.clear();
    report();
    if (stop_flag) return stopped_early;
    return failures_.empty() ? done : failed;
  }

 private:
  // What each input holds, all inputs at once; wanted are the frames asked for that are not done.
  std::vector<stream::QueuedInput> look_through() {
    const auto& paths = options_.inputs;
    scans_.resize(paths.size());
    std::atomic<std::size_t> looked_at{0};
    tbb::parallel_for(std::size_t{0}, paths.size(), [&](std::size_t i) {
      if (stop_flag) return;
      scans_[i] = stream::scan_input(paths[i], options_.reader);
      const std::size_t now = ++looked_at;
      const std::lock_guard guard(mutex_);
      bar_.show(0, fmt::format("looking at file {} of {}", now, paths.size()));
    });
    std::vector<stream::QueuedInput> wanted(paths.size());
    for (std::size_t i = 0; i < paths.size(); ++i) {
      wanted[i].path = paths[i];
      for (const std::int64_t frame : asked_for(i)) {
        ++asked_;
        if (!folder_.is_finished({i, frame})) wanted[i].frames.push_back(frame);
      }
      to_do_ += wanted[i].frames.size();
    }
    return wanted;
  }

  std::vector<std::int64_t> asked_for(std::size_t i) {
    const auto& scan = scans_[i];
    if (stop_flag) return {};  // it may not have been looked at
    std::vector<std::int64_t> frames;
    const bool one = options_.frames == Frames::one;
    const bool missing = one && options_.frame >= scan.frames;
    // Of a file that breaks off, the frames before that are whole; which one is the last is not known.
    if (!scan.broken.empty() && (!one || missing)) fail({i, -1, scan.broken});
    if (scan.broken.empty() && missing) {
      fail({i, -1,
            fmt::format("{}: --frame {}: no such frame; 0 to {}; correct it, or use last",
                        options_.inputs[i].string(), options_.frame, scan.frames - 1)});
    }
    if (one && !missing) frames.push_back(options_.frame);
    if (options_.frames == Frames::last && scan.broken.empty()) frames.push_back(scan.frames - 1);
    if (options_.frames == Frames::all) {
      for (std::int64_t f = 0; f < scan.frames; ++f) frames.push_back(f);
    }
    return frames;
  }

  bool one_of_many(std::size_t input) const {
    return options_.frames == Frames::all && scans_[input].frames > 1;
  }

  void work(stream::QueuedFrame& item, stream::FrameQueue& queue) {
    if (stop_flag) {
      queue.stop();
      return;
    }
    const auto& path = options_.inputs[item.input];
    try {
      if (!item.error.empty()) throw InputError(item.error);
      FramePlan plan = plan_frame(item.frame, options_, place_of(path, item.number));
      check_memory(plan);
      const stream::MemoryBudget::Share share(budget_, plan.memory);
      compute(item, std::move(plan));
    } catch (const std::bad_alloc&) {
      fail({item.input, item.number, place_of(path, item.number) + ": out of memory; use a larger voxel"});
    } catch (const InputError& error) {
      fail({item.input, item.number, error.what()});
    } catch (const std::exception& error) {
      fail({item.input, item.number, error.what()});
      if (++unwritten_ >= most_unwritten) queue.stop();  // most likely no frame can be written any more
    }
  }

  // Frames wait for each other's memory; one that never has room is refused.
  void check_memory(const FramePlan& plan) const {
    if (options_.memory == 0 || plan.memory <= options_.memory) return;
    throw InputError(fmt::format(
        "the field may need {:.3g} MB; --memory allows {:.3g} MB; allow more, or use a larger --voxel",
        1e-6 * plan.memory, 1e-6 * options_.memory));
  }

  void compute(stream::QueuedFrame& item, FramePlan plan) {
    const bool many = one_of_many(item.input);
    const auto periods = warning_of_periods(item.frame, options_, options_.inputs[item.input].string());
    const auto walls = warnings_of_walls(options_.walls, plan.request.box);
    const auto place = folder_.place_of({item.input, item.number}, many);
    const FrameTask task{options_.inputs[item.input], scans_[item.input].kind, item.number,
                         options_.output / place};
    const FrameOutput output = write_frame(task, item.frame, std::move(plan), options_);
    folder_.finish({item.input, item.number}, many, output.files.summary);
    const std::lock_guard guard(mutex_);
    if (!output.missing_figures.empty() && !figures_warned_) bar_.line("warning: " + output.missing_figures);
    figures_warned_ = figures_warned_ || !output.missing_figures.empty();
    if (!coarse_warned_.count(item.input)) warn_of_resolution(item);
    if (!periods.empty() && warned_.insert(periods).second) bar_.line("warning: " + periods);
    for (const auto& line : walls) {
      if (warned_.insert(line).second) bar_.line("warning: " + line);
    }
    ++computed_;
    unwritten_ = 0;
    show();
  }

  // Once an input; the mutex is held.
  void warn_of_resolution(const stream::QueuedFrame& item) {
    const auto line =
        resolution_warning(options_.inputs[item.input].string(), item.position_resolution, options_.voxel);
    if (line.empty()) return;
    coarse_warned_.insert(item.input);
    bar_.line("warning: " + line);
  }

  void fail(studies::BatchFailure failure) {
    const std::lock_guard guard(mutex_);
    // A reader names the file and line; which frame that is, only the batch knows.
    const std::string where =
        failure.frame >= 0 ? place_of(options_.inputs[failure.input], failure.frame) : std::string();
    if (!where.empty() && failure.message.find(where) == std::string::npos) {
      failure.message = fmt::format("{}: {}", where, failure.message);
    }
    bar_.line("error: " + failure.message);
    failures_.push_back(std::move(failure));
  }

  void show() {
    const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
    const double rate = static_cast<double>(computed_) / std::max(seconds, 1e-9);
    const std::size_t left = to_do_ - std::min(to_do_, computed_ + failures_.size());
    bar_.show(to_do_ > 0 ? static_cast<double>(computed_) / static_cast<double>(to_do_) : 1,
              fmt::format("{} of {} frames  {:.3g} frames/s  {} left", computed_, to_do_, rate,
                          ProgressBar::duration(static_cast<double>(left) / rate)));
  }

  void draw_over_time() {
    const bool figure = options_.figures && figures::plotting_available();
    for (std::size_t i = 0; i < options_.inputs.size(); ++i) {
      const auto frames = folder_.frames_of(i);
      if (!one_of_many(i) || frames.size() < 2) continue;
      try {
        write_series(i, frames);
        studies::write_time_space(options_.output / folder_.place_of({i, 0}, false), frames,
                                  time_space_text(options_.inputs[i], options_), figure, options_.formats);
      } catch (const std::exception& error) {
        bar_.line(fmt::format("warning: {}: the map over time is missing: {}", options_.inputs[i].string(),
                              error.what()));
      }
    }
  }

  // For ParaView, which opens the frames as one animation.
  void write_series(std::size_t input, const std::vector<studies::TimeSpaceFrame>& frames) const {
    const auto series = options_.output / folder_.place_of({input, 0}, false);
    std::vector<io::PvdEntry> entries;
    for (const auto& frame : frames) {
      if (!std::filesystem::exists(frame.folder / "fields.vti")) continue;
      const double order = static_cast<double>(frame.step >= 0 ? frame.step : frame.number);
      entries.push_back({std::isfinite(frame.time) ? frame.time : order,
                         (frame.folder.filename() / "fields.vti").string()});
    }
    if (!entries.empty()) io::write_pvd(series / "fields.pvd", std::move(entries));
  }

  void report() const {
    const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
    const auto table = (options_.output / "table.csv").string();
    if (compute_.json) {
      Json json{{"frames", asked_},        {"computed", computed_}, {"skipped", skipped_},
                {"failed", Json::array()}, {"table", table},        {"seconds", seconds}};
      for (const auto& f : failures_) {
        json["failed"].push_back({{"file", options_.inputs[f.input].string()},
                                  {"frame", f.frame >= 0 ? Json(f.frame) : Json(nullptr)},
                                  {"message", f.message}});
      }
      fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
      return;
    }
    fmt::print("{} frames of {} files: {} computed, {} finished before, {} failures, {:.3g} s\n", asked_,
               options_.inputs.size(), computed_, skipped_, failures_.size(), seconds);
    if (stop_flag) fmt::print("Stopped; the same command goes on\n");
    fmt::print("Results in {}\n", table);
  }

  static constexpr int most_unwritten = 5;

  const VoidsOptions& options_;
  const ComputeOptions& compute_;
  studies::BatchFolder& folder_;
  stream::MemoryBudget budget_;
  ProgressBar bar_;
  std::vector<stream::InputScan> scans_;
  std::vector<studies::BatchFailure> failures_;
  std::size_t asked_ = 0, to_do_ = 0, computed_ = 0, skipped_ = 0;
  std::atomic<int> unwritten_{0};  // frames in a row that could not be written
  bool figures_warned_ = false;
  std::set<std::string> warned_;
  std::set<std::size_t> coarse_warned_;  // inputs whose coarse positions were warned of
  Clock::time_point begin_;
  std::mutex mutex_;
};

// What an earlier batch or `voids` left in the folder.
void clear(const VoidsOptions& options) {
  std::vector<std::string> stems = studies::batch_stems(options.output);
  for (const auto& input : options.inputs) stems.push_back(stem_of(input));
  for (const auto& stem : stems) {
    clear_results(options.output / stem);
    std::error_code error;
    std::filesystem::remove(options.output / stem, error);  // where nothing else is in it
  }
  std::error_code error;
  for (const char* name : {"table.csv", "batch.json"}) std::filesystem::remove(options.output / name, error);
}

void batch(const VoidsWords& words, const CLI::App& command) {
  apply_compute_options(words.compute);
  const VoidsOptions options = read_voids_options(words);
  studies::BatchSetup setup{{}, options_of(command), kVersion, options.overwrite};
  bool any = false;
  for (const auto& path : options.inputs) {
    setup.inputs.push_back(studies::batch_input(path, stem_of(path)));
    any = any || setup.inputs.back().size >= 0;
  }
  if (!any) {
    throw InputError(
        options.inputs.front().string() +
        ": no such file, and none of the other inputs either; at least one is needed; correct the "
        "names");
  }
  if (options.overwrite) clear(options);
  studies::BatchFolder folder(options.output, std::move(setup));
  if (!folder.other_version().empty()) {
    fmt::print(stderr,
               "warning: frames in {} were computed by version {}; use --overwrite to compute all anew\n",
               options.output.string(), folder.other_version());
  }
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) std::signal(signal, [](int) { stop_flag = true; });
  const int status = Batch(options, words.compute, folder).run();
  if (status != done) throw Exit{status};
}

}  // namespace

void add_batch(CLI::App& root) {
  auto words = std::make_shared<VoidsWords>();
  words->frame = "all";
  CLI::App* c =
      root.add_subcommand("batch", "void fraction from many particle files and frames, on all cores");
  add_voids_flags(*c, *words);
  c->add_option("--memory", words->memory,
                "what fields may take together, such as 4GB (default: 60 % of what is free)");
  c->callback([words, c] { batch(*words, *c); });
}

}  // namespace interstice::apps
