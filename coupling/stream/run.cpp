#include "coupling/stream/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/error.h"
#include "coupling/io/atomic_file.h"
#include "coupling/io/trajectory.h"
#include "coupling/scene/write_scene.h"
#include "coupling/stream/contact_report.h"
#include "coupling/stream/field_output.h"
#include "coupling/stream/field_stream.h"
#include "coupling/stream/run_report.h"
#include "coupling/stream/run_state.h"
#include "coupling/stream/schedule.h"
#include "coupling/stream/series.h"
#include "coupling/stream/step_choice.h"
#include "dem/grain_stress.h"
#include "dem/statistics.h"

namespace interstice::stream {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

constexpr std::int64_t kStepsPerGuard = 2000;
constexpr double kDefaultCheckpointSeconds = 60;
constexpr double kPollSeconds = 0.2;
// dt over sqrt(m/k): 0.2 is 0.05 of a collision time, 0.8 is 0.2 of it (docs/PHYSICS.md).
constexpr double kWarnRatio = 0.2, kRefuseRatio = 0.8;
constexpr double kWarnDamping = 1;
constexpr double kRefuseFrequency = 2;  // velocity Verlet: stable where omega dt < 2

class Run {
 public:
  Run(const scene::Scene& scene, const RunOptions& options);
  RunResult go();

 private:
  void begin_files();
  void enter_phase();
  bool phase_over(std::string& why);
  bool rain_finished() const;
  void choose_phase_checks();
  void watch_quiet();
  void pour_rain();
  void record(bool phase_end);
  void append_frame(const io::ParticleFrame& frame);
  void fill(io::ParticleFrame& frame) const;
  void fill_contacts(const std::vector<Snapshot::Due>& due, io::ParticleFrame& frame) const;
  void guard();
  void checkpoint();
  std::int64_t next_event() const;
  std::int64_t phase_limit() const;
  void advance_to(std::int64_t target);
  bool stop_requested(RunResult& result) const;
  void report_progress();
  double latest_end() const;
  RunResult close(RunResult result);
  double wall_seconds() const { return state_.wall_seconds + seconds_since(started_); }
  const scene::Phase& phase() const { return scene_.phases[state_.phase]; }

  const scene::Scene& scene_;
  const RunOptions& options_;
  Clock::time_point started_ = Clock::now();
  dem::Model model_;
  StepChoice choice_;
  Vec3d origin_;  // of the engine's coordinates, in the scene's [m]
  dem::Simulation sim_;
  std::vector<PhasedRain> rains_;
  RunState state_;
  std::string fingerprint_;      // the resolved scene
  std::string checkpoint_mark_;  // with what else a checkpoint must agree in
  double dt_;
  Recurrence series_every_, frame_every_, quiet_every_;
  std::vector<Recurrence> field_every_, rain_every_;
  std::optional<Series> series_;
  std::optional<io::TrajectoryWriter> trajectory_;
  std::optional<FieldOutput> output_;
  std::optional<FieldStream> stream_;
  bool warned_ = false;
  double file_seconds_ = 0;
  Clock::time_point last_checkpoint_ = Clock::now(), last_report_ = Clock::now();
  bool phase_to_keep_ = false;  // a phase has ended since the last checkpoint
  double reported_steps_ = 0, reported_time_ = 0;
};

Run::Run(const scene::Scene& scene, const RunOptions& options)
    : scene_(scene),
      options_(options),
      model_(build_model(scene)),
      choice_(choose_step(scene, model_)),
      origin_(scene.domain.box.lo),
      sim_(relative_to(origin_, model_), choice_.step,
           {.reference = options.reference,
            .precision = options.mixed ? dem::Precision::mixed : dem::Precision::real64,
            .energies = scene.output.energy,
            .sleep_tolerance = scene.step.sleeping ? scene.step.sleep_tolerance : 0,
            .rates = {0.5 * scene.step.short_below.value_or(0), choice_.short_steps}}),
      rains_(build_rain(scene, origin_)),
      fingerprint_(scene::resolved_toml(scene)),
      checkpoint_mark_(fingerprint_ + "# precision: " + options.precision + "\n"),
      dt_(choice_.step),
      series_every_(Recurrence::of(scene.output.series, dt_)),
      frame_every_(Recurrence::of(scene.output.trajectory, dt_)) {
  for (const scene::Field& f : scene.fields) field_every_.push_back(Recurrence::of(f.every.value_or(0), dt_));
  for (const PhasedRain& r : rains_) rain_every_.push_back(Recurrence::of(r.interval, dt_));
  state_.field_frames.assign(scene.fields.size(), 0);
}

void Run::begin_files() {
  const auto& folder = options_.folder;
  std::optional<double> keep_until;
  if (options_.resume) {
    read_checkpoint(folder / "checkpoint.h5", sim_, rains_, state_, checkpoint_mark_);
    for (std::size_t i = 0; i < state_.spans.size(); ++i) state_.spans[i].name = scene_.phases.at(i).name;
    keep_until = sim_.time() + 0.25 * dt_;
    if (state_.phase < scene_.phases.size()) choose_phase_checks();
  } else {
    io::write_text_atomically(folder / "scene.resolved.toml", fingerprint_);
  }
  if (scene_.output.series > 0) series_.emplace(folder / "series.csv", scene_, keep_until);
  if (scene_.output.trajectory > 0) {
    trajectory_ = keep_until ? io::TrajectoryWriter::resume(folder / "trajectory.h5part", *keep_until)
                             : io::TrajectoryWriter::create(folder / "trajectory.h5part");
  }
  output_.emplace(scene_, folder, options_.figures, keep_until);
  stream_.emplace([this](const Snapshot& s) { output_->write(s); });
}

void Run::enter_phase() {
  state_.phase_start = sim_.step();
  state_.quiet_since = -1;
  choose_phase_checks();
  state_.spans.push_back({phase().name, sim_.time(), sim_.time(), ""});
  for (std::size_t w = 0; w < scene_.walls.size(); ++w) {
    Vec3d velocity{0, 0, 0};
    for (const scene::Motion& m : scene_.walls[w].motion) {
      if (m.phase == phase().name) velocity = velocity + m.velocity;
    }
    sim_.set_wall_velocity(w, velocity);
  }
}

bool Run::rain_finished() const {
  for (const PhasedRain& r : rains_) {
    if (r.phase == phase().name && !r.rain.finished()) return false;
  }
  return true;
}

std::int64_t Run::phase_limit() const {
  return state_.phase_start + steps_in(phase().duration.value_or(phase().at_most), dt_);
}

void Run::choose_phase_checks() {
  quiet_every_ = {phase().duration ? 0 : std::max<std::int64_t>(1, steps_in(phase().settled_time, dt_) / 10)};
}

/// Grains are at rest when their kinetic energy per grain is below a fraction of m g d.
void Run::watch_quiet() {
  const dem::MotionStatistics m = dem::motion_statistics(sim_);
  const double per_grain = sim_.grains() == 0 ? 0 : m.kinetic_energy / static_cast<double>(sim_.grains());
  const bool quiet = per_grain <= phase().settled_energy * m.fall_energy_mean;
  if (!quiet) state_.quiet_since = -1;
  if (quiet && state_.quiet_since < 0) state_.quiet_since = sim_.step();
}

bool Run::phase_over(std::string& why) {
  if (quiet_every_.due(
          sim_.step())) {  // at fixed steps only, so that a resumed run ends the phase at the same one
    if (phase().until_settled) watch_quiet();
    const bool inserted = !phase().until_inserted || rain_finished();
    const std::int64_t quiet_for = state_.quiet_since < 0 ? -1 : sim_.step() - state_.quiet_since;
    const bool settled = !phase().until_settled || quiet_for >= steps_in(phase().settled_time, dt_);
    if (inserted && settled) {
      why = phase().until_inserted && phase().until_settled ? "inserted and settled"
            : phase().until_settled                         ? "settled"
                                                            : "inserted";
      return true;
    }
  }
  if (sim_.step() < phase_limit()) return false;
  why = phase().duration ? "duration" : "at_most";
  if (!phase().duration && options_.warn) {
    options_.warn(fmt::format("phase '{}' ended by at_most = {} s, before its condition was met",
                              phase().name, phase().at_most));
  }
  return true;
}

void Run::pour_rain() {
  for (std::size_t i = 0; i < rains_.size(); ++i) {
    if (rains_[i].phase != phase().name || rains_[i].rain.finished()) continue;
    if (rain_every_[i].due(sim_.step())) dem::pour(sim_, rains_[i].rain);
  }
}

void Run::fill(io::ParticleFrame& frame) const {
  dem::GrainColumns c;
  sim_.copy_columns(c);
  frame.time = sim_.time();
  frame.step = sim_.step();
  frame.density.resize(c.id.size());
  for (std::size_t i = 0; i < c.id.size(); ++i) {
    frame.density[i] = model_.materials[static_cast<std::size_t>(c.material[i])].density;
  }
  frame.id = std::move(c.id);
  frame.x = std::move(c.x), frame.y = std::move(c.y), frame.z = std::move(c.z);
  for (std::size_t i = 0; i < frame.x.size(); ++i) {
    frame.x[i] += origin_.x, frame.y[i] += origin_.y, frame.z[i] += origin_.z;
  }
  frame.radius = std::move(c.radius);
  frame.vx = std::move(c.vx), frame.vy = std::move(c.vy), frame.vz = std::move(c.vz);
  frame.wx = std::move(c.wx), frame.wy = std::move(c.wy), frame.wz = std::move(c.wz);
  frame.material = std::move(c.material), frame.layer = std::move(c.layer);
  frame.bonded.assign(frame.id.size(), 0);
  frame.bounds = scene_.domain.box;
  for (int axis = 0; axis < 3; ++axis) {
    frame.periodic[axis] = scene_.domain.boundary[axis] == scene::Boundary::periodic;
  }
  for (std::size_t w = 0; w < sim_.walls().size(); ++w) {
    frame.walls.push_back(
        {w < scene_.walls.size() ? scene_.walls[w].name : "boundary", translated(sim_.walls()[w], origin_)});
  }
}

/// What only fields of contacts need is worked out for them alone.
void Run::fill_contacts(const std::vector<Snapshot::Due>& due, io::ParticleFrame& frame) const {
  const bool wanted = std::any_of(due.begin(), due.end(), [&](const Snapshot::Due& d) {
    const scene::FieldQuantities& q = scene_.fields[d.field].recipe.quantities;
    return q.coordination || q.stress;
  });
  if (!wanted) return;
  dem::GrainStresses contacts = dem::grain_stresses(sim_);
  frame.coordination = std::move(contacts.contacts);
  frame.stress = std::move(contacts.stress);
}

void Run::record(bool phase_end) {
  const std::int64_t step = sim_.step();
  if (series_ && series_every_.due(step)) series_->sample(sim_);
  std::vector<Snapshot::Due> due;
  for (std::size_t f = 0; f < scene_.fields.size(); ++f) {
    if (phase_end || field_every_[f].due(step)) due.push_back({f, state_.field_frames[f]++});
  }
  const bool frame_due = trajectory_ && (phase_end || frame_every_.due(step));
  if (frame_due || !due.empty() || phase_end) {
    Snapshot& snapshot = stream_->acquire();
    fill(snapshot.frame);
    fill_contacts(due, snapshot.frame);
    snapshot.phase = phase().name;
    snapshot.phase_end = phase_end;
    snapshot.due = std::move(due);
    if (frame_due || (trajectory_ && !snapshot.due.empty())) append_frame(snapshot.frame);
    stream_->submit();
  }
}

void Run::append_frame(const io::ParticleFrame& frame) {
  const auto start = Clock::now();
  trajectory_->append(frame);
  file_seconds_ += seconds_since(start);
}

/// Looks at the contacts as they are: stiff ones make the integration inaccurate, then unstable.
void Run::guard() {
  const dem::StepCheck check = dem::check_step(sim_);
  if (scene_.step.allow_unstable) return;
  const std::string where =
      fmt::format("at step {} (t = {:.6g} s) the time step {:.3g} s is", sim_.step(), sim_.time(), dt_);
  const std::string contact =
      fmt::format("{} {:.2f} of sqrt(m/k) of the contact between grain {} and {}", where, check.ratio,
                  check.grain_a, check.grain_b < 0 ? "a wall" : fmt::format("grain {}", check.grain_b));
  if (check.ratio > kRefuseRatio) {
    throw UnstableError(contact + ": contacts gain energy from 0.8 on; use a smaller [time] step");
  }
  if (check.frequency > kRefuseFrequency) {
    throw UnstableError(
        fmt::format("{} {:.2f} of the fastest vibration of grain {} among its contacts "
                    "(1/omega): the integration is stable below 2; use a smaller [time] step",
                    where, check.frequency, check.frequency_grain));
  }
  if (warned_ || !options_.warn) return;
  if (check.ratio > kWarnRatio) {
    options_.warn(contact + "; above 0.2 the restitution is wrong by percents");
    warned_ = true;
  } else if (check.damping > kWarnDamping) {
    options_.warn(
        fmt::format("{} {:.2f} of the time in which the dashpots of its contacts stop grain {}; above 1 "
                    "it may shake for ever, and a bed heat up: use a smaller [time] step",
                    where, check.damping, check.damping_grain));
    warned_ = true;
  }
}

void Run::checkpoint() {
  guard();  // the last good state is not overwritten by a bad one
  const auto start = Clock::now();
  stream_->finish();  // what the checkpoint promises as written is written
  RunState state = state_;
  state.wall_seconds = wall_seconds();
  write_checkpoint(options_.folder / "checkpoint.h5", sim_, rains_, state, checkpoint_mark_);
  last_checkpoint_ = Clock::now();
  phase_to_keep_ = false;
  file_seconds_ += seconds_since(start);
}

std::int64_t Run::next_event() const {
  const std::int64_t step = sim_.step();
  std::int64_t next = std::min({phase_limit(), series_every_.next(step), frame_every_.next(step)});
  next = std::min(next, step == 0 ? 1 : Recurrence{kStepsPerGuard}.next(step));
  next = std::min(next, quiet_every_.next(step));
  for (const Recurrence& r : field_every_) next = std::min(next, r.next(step));
  for (std::size_t i = 0; i < rains_.size(); ++i) {
    if (!rains_[i].rain.finished()) next = std::min(next, rain_every_[i].next(step));
  }
  if (options_.until) next = std::min(next, std::max(step + 1, steps_in(*options_.until, dt_)));
  return next;
}

void Run::advance_to(std::int64_t target) {
  const auto start = Clock::now();
  const std::int64_t before = sim_.step();
  sim_.advance(target - before);
  state_.step_seconds += seconds_since(start);
  state_.particle_steps += static_cast<double>(sim_.grains()) * static_cast<double>(sim_.step() - before);
}

double Run::latest_end() const {
  double end = static_cast<double>(state_.phase_start) * dt_;
  for (std::size_t p = state_.phase; p < scene_.phases.size(); ++p) {
    end += scene_.phases[p].duration.value_or(scene_.phases[p].at_most);
  }
  return options_.until ? std::min(end, *options_.until) : end;
}

void Run::report_progress() {
  const double passed = seconds_since(last_report_);
  if (!options_.progress || passed < 0.5) return;
  Progress p;
  p.time = sim_.time();
  p.end = latest_end();
  p.phase = phase().name;
  p.grains = sim_.grains();
  p.rate = (state_.particle_steps - reported_steps_) / passed;
  const double pace = (sim_.time() - reported_time_) / passed;
  p.seconds_left = pace > 0 ? (p.end - p.time) / pace : 0;
  options_.progress(p);
  reported_steps_ = state_.particle_steps;
  reported_time_ = sim_.time();
  last_report_ = Clock::now();
}

bool Run::stop_requested(RunResult& result) const {
  if (options_.stop && *options_.stop) {
    result.exit_reason = "signal";
  } else if (options_.time_limit && seconds_since(started_) >= *options_.time_limit) {
    result.exit_reason = "time limit";
  } else if (options_.until && sim_.step() >= steps_in(*options_.until, dt_)) {
    result.exit_reason = "until";
  }
  return !result.exit_reason.empty();
}

RunResult Run::go() {
  begin_files();
  const ContactReport contacts = report_contacts(scene_, model_, choice_.speed, choice_.step);
  for (const auto& warnings : {choice_.warnings, contacts.warnings}) {
    for (const std::string& w : warnings) {
      if (options_.warn) options_.warn(w);
    }
  }
  RunResult result;
  if (!options_.resume) {
    sim_.add_grains(build_placed_grains(scene_, origin_));
    enter_phase();
    pour_rain();
    record(false);
    checkpoint();
  }
  reported_steps_ = state_.particle_steps;
  reported_time_ = sim_.time();
  const double checkpoint_seconds =
      scene_.output.checkpoint > 0 ? scene_.output.checkpoint : kDefaultCheckpointSeconds;
  while (state_.phase < scene_.phases.size()) {
    const auto awake = static_cast<double>(sim_.grains() - sim_.grains_asleep());
    const auto chunk = 1 + static_cast<std::int64_t>(kPollSeconds * 4e6 / (awake + 50));
    advance_to(std::min(next_event(), sim_.step() + chunk));
    pour_rain();
    if (sim_.step() % kStepsPerGuard == 0 || sim_.step() == 1) guard();  // placed grains may overlap already
    std::string why;
    const bool over = phase_over(why);
    record(over);
    if (over) {
      state_.spans.back().end = sim_.time();
      state_.spans.back().ended_by = why;
      if (++state_.phase < scene_.phases.size()) enter_phase();
    }
    if (state_.phase == scene_.phases.size()) break;
    report_progress();
    if (stop_requested(result)) break;
    phase_to_keep_ = phase_to_keep_ || over;
    // Drawing a phase's figures takes seconds, in which the run goes on.
    if ((phase_to_keep_ && stream_->idle()) || seconds_since(last_checkpoint_) >= checkpoint_seconds)
      checkpoint();
  }
  result.finished = state_.phase == scene_.phases.size();
  return close(result);
}

RunResult Run::close(RunResult result) {
  if (result.finished) result.exit_reason = "finished";
  checkpoint();
  if (output_ && result.finished) output_->finish(state_.spans);
  result.time = sim_.time();
  result.steps = sim_.step();
  result.grains = static_cast<std::int64_t>(sim_.grains());
  result.grains_inserted = sim_.grains_added();
  result.grains_lost = sim_.grains_lost();
  result.wall_seconds = wall_seconds();
  result.step_seconds = state_.step_seconds;
  result.particle_steps = state_.particle_steps;
  result.field_seconds = stream_->work_seconds();
  result.field_wait_seconds = stream_->wait_seconds();
  result.file_seconds = file_seconds_;
  result.phases = state_.spans;
  write_run_report(options_.folder / "run.json", scene_, options_, choice_, result);
  return result;
}

}  // namespace

RunResult run_scene(const scene::Scene& scene, const RunOptions& options) { return Run(scene, options).go(); }

}  // namespace interstice::stream
