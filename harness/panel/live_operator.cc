#include "harness/panel/live_operator.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "harness/fault_cases/case_run.h"
#include "harness/fault_cases/fault_case.h"
#include "harness/fault_cases/inject.h"
#include "harness/fault_cases/machine_faults.h"
#include "harness/fault_plan/carrier_fit.h"
#include "harness/fault_plan/fault_fit.h"

namespace towbench::harness {
namespace {

bool is_same_place(const Fault& a, const Fault& b) {
  return a.place == b.place && a.kind == b.kind;
}

void refuse_unless_possible(const Fault& fault, const ExperimentFixture& fixture) {
  const auto place = name_of(fault.place) + " " + std::string(fault.row().name);
  if (const auto why = why_not_by_hand(fault.row()); !why.empty()) {
    throw FixtureError({.file = "fault"}, place, std::string(why));
  }
  if (fault.row().start == FaultStart::kWholeRun) {
    throw FixtureError({.file = "fault"}, place,
                       "before the start: a machine is built like that or not");
  }
  if (const char* lacks = lacking(fault, fixture.rig.parameters)) {
    throw FixtureError({.file = "fault"}, place, lacks);
  }
  if (!fixture.experiment.reference.empty()) {
    refuse_faults_beyond({fault}, FaultReach::kMachineAndLink);
    if (fault.kind == FaultKind::kBounce) {
      throw FixtureError({.file = "fault"}, place,
                         "before the start: it looks at what the run without it would do");
    }
  }
}

}  // namespace

LiveOperator::LiveOperator(const ExperimentFixture& fixture, std::uint64_t seed, Pace pace,
                           bool holds, const std::atomic<bool>& stop)
    : fixture_(fixture),
      seed_(seed),
      holds_(holds),
      stop_(stop),
      pace_(pace),
      done_(fixture.experiment.operator_acts) {}

void LiveOperator::give(Command command) {
  {
    const std::lock_guard lock(mutex_);
    commands_.push_back(std::move(command));
    wanted_.store(true, std::memory_order_release);
  }
  changed_.notify_all();
}

void LiveOperator::type(std::string bytes) {
  give({.kind = OperatorAct::Kind::kTyped, .text = std::move(bytes), .fault = {}});
}

void LiveOperator::inject_now(Fault fault) {
  refuse_unless_possible(fault, fixture_);
  give({.kind = OperatorAct::Kind::kFault, .text = {}, .fault = std::move(fault)});
}

void LiveOperator::clear(const FaultPlace& place, FaultKind kind) {
  Fault fault;
  fault.place = place;
  fault.kind = kind;
  give({.kind = OperatorAct::Kind::kCleared, .text = {}, .fault = std::move(fault)});
}

void LiveOperator::set_speed(double speed) {
  {
    const std::lock_guard lock(mutex_);
    pace_ = {.speed = speed, .paused = false};
    step_until_ns_ = -1;
    anchor_ns_ = -1;
  }
  give({.text = speed > 0 ? fmt::format("speed {:.4g}", speed) : "full speed", .fault = {}});
}

void LiveOperator::pause(bool paused) {
  {
    const std::lock_guard lock(mutex_);
    pace_.paused = paused;
    step_until_ns_ = -1;
    anchor_ns_ = -1;
  }
  give({.text = paused ? "pause" : "go on", .fault = {}});
}

void LiveOperator::step(core::Nanoseconds length_ns) {
  {
    const std::lock_guard lock(mutex_);
    pace_.paused = true;
    step_until_ns_ = now_ns() + length_ns;
  }
  give({.text = fmt::format("step {} us", length_ns / 1000), .fault = {}});
}

void LiveOperator::finish() {
  give({.kind = OperatorAct::Kind::kFinished, .text = "finish", .fault = {}});
}

LiveOperator::Pace LiveOperator::pace() const {
  const std::lock_guard lock(mutex_);
  return pace_;
}

std::vector<std::string> LiveOperator::active_faults() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> words;
  for (const auto& fault : injected_) {
    if (!fault.duration_s) {
      words.push_back(name_of(fault.place) + " " + std::string(fault.row().name));
    }
  }
  return words;
}

std::string LiveOperator::take_trouble() {
  const std::lock_guard lock(mutex_);
  return std::exchange(trouble_, {});
}

std::span<const OperatorAct> LiveOperator::at(core::Nanoseconds now_ns, SteeredBench& bench) {
  now_ns_.store(now_ns, std::memory_order_relaxed);
  if (!wanted_.load(std::memory_order_acquire) && !stop_.load(std::memory_order_relaxed)) {
    return {};
  }
  std::unique_lock lock(mutex_);
  while (true) {
    while (!commands_.empty()) {
      const auto command = std::move(commands_.front());
      commands_.pop_front();
      carry_out(command, now_ns, bench);
    }
    const bool finished = !done_.empty() && done_.back().kind == OperatorAct::Kind::kFinished;
    if (finished || stop_.load(std::memory_order_relaxed)) {
      break;
    }
    const auto until = due(now_ns);
    if (!until) {
      break;
    }
    // Who waits at the other end hears now and then that it goes on.
    constexpr auto kSlice = std::chrono::milliseconds(200);
    const auto slice = HostClock::now() + kSlice;
    changed_.wait_until(lock, std::min(*until, slice));
    if (slice < *until) {
      bench.wait_a_little();
    }
  }
  const auto fresh = std::span<const OperatorAct>(done_).subspan(told_);
  told_ = done_.size();
  wanted_.store(pace_.paused || pace_.speed > 0, std::memory_order_relaxed);
  return fresh;
}

std::optional<LiveOperator::HostClock::time_point> LiveOperator::due(core::Nanoseconds now_ns) {
  if (pace_.paused ? now_ns < step_until_ns_ : pace_.speed <= 0) {
    return std::nullopt;
  }
  const auto host = HostClock::now();
  if (pace_.paused) {
    return host + std::chrono::seconds(1);
  }
  // A host that fell behind is not made to hurry: the pace starts anew from here.
  constexpr auto kForgiven = std::chrono::milliseconds(100);
  const auto ahead = [&] {
    const auto passed = static_cast<double>(now_ns - anchor_ns_) / pace_.speed;
    return anchor_host_ + std::chrono::nanoseconds(static_cast<core::Nanoseconds>(passed));
  };
  if (anchor_ns_ < 0 || ahead() < host - kForgiven) {
    anchor_ns_ = now_ns;
    anchor_host_ = host;
  }
  const auto target = ahead();
  return target > host ? std::optional(target) : std::nullopt;
}

void LiveOperator::note(OperatorAct::Kind kind, std::string text) {
  done_.push_back({.time_ns = now_ns(), .kind = kind, .text = std::move(text)});
}

void LiveOperator::carry_out(const Command& command, core::Nanoseconds /*now_ns*/,
                             SteeredBench& bench) {
  std::string refusal;
  switch (command.kind) {
    case OperatorAct::Kind::kFault:
      refusal = start_fault(*command.fault, bench);
      break;
    case OperatorAct::Kind::kCleared:
      refusal = end_fault(*command.fault, bench);
      break;
    case OperatorAct::Kind::kTyped:
    case OperatorAct::Kind::kChanged:
    case OperatorAct::Kind::kClock:
    case OperatorAct::Kind::kHolds:
    case OperatorAct::Kind::kFinished:
      note(command.kind, command.text);
      break;
  }
  if (!refusal.empty()) {
    trouble_ = std::move(refusal);
  }
}

std::string LiveOperator::start_fault(const Fault& fault, SteeredBench& bench) {
  for (const auto& other : injected_) {
    if (is_same_place(other, fault) && !other.duration_s) {
      return fmt::format("{} {} already", name_of(fault.place), fault.row().name);
    }
  }
  Fault now = fault;
  const auto onset_ns = bench.now_ns() + bench.exchange_ns();
  now.trigger = {.value = core::seconds(onset_ns)};
  const auto injection = injection_of(now);
  const auto& host = injection.host;
  if (injection.events.empty() && injection.link.empty() && host.stalls.empty() &&
      host.steps.empty()) {
    return fmt::format("\"{}\" would take no effect in this run", describe(now));
  }
  if (!bench.inject(injection)) {
    return fmt::format("\"{}\" cannot be made here", describe(now));
  }
  injected_.push_back(now);
  note(OperatorAct::Kind::kFault, describe(now));
  return {};
}

std::string LiveOperator::end_fault(const Fault& fault, SteeredBench& bench) {
  const auto active = std::find_if(injected_.begin(), injected_.end(), [&](const Fault& other) {
    return is_same_place(other, fault) && !other.duration_s;
  });
  if (active == injected_.end()) {
    return fmt::format("{} is not {} by hand", name_of(fault.place), fault.row().name);
  }
  Fault over = *active;
  const auto until_ns = bench.now_ns() + bench.exchange_ns();
  over.duration_s = core::seconds(until_ns) - over.trigger.value;
  const auto before = injection_of(*active);
  auto after = injection_of(over);
  // What has been given to the machine cannot be taken back: only an end can be added.
  const bool adds = before.link.empty() && before.host.stalls.empty() &&
                    before.host.steps.empty() && after.events.size() > before.events.size() &&
                    std::equal(before.events.begin(), before.events.end(), after.events.begin(),
                               [](const auto& a, const auto& b) {
                                 return a.time_ns == b.time_ns && a.kind == b.kind;
                               });
  if (!adds) {
    return fmt::format("\"{}\" lasts to the end of the run", describe(*active));
  }
  after.events.erase(after.events.begin(),
                     after.events.begin() + static_cast<std::ptrdiff_t>(before.events.size()));
  if (!bench.inject(after)) {
    return fmt::format("\"{}\" cannot be cleared here", describe(*active));
  }
  *active = over;
  note(OperatorAct::Kind::kCleared, describe(over));
  return {};
}

Injection LiveOperator::injection_of(const Fault& fault) const {
  const auto end_ns = core::nanoseconds(fixture_.experiment.duration_limit_s);
  const auto onset_ns = core::nanoseconds(fault.trigger.value);
  auto so_far = fixture_;
  so_far.experiment.operator_acts = done_;
  so_far.experiment.faults = {};
  // Only these look at what the undisturbed run would do.
  const bool looks_ahead = fault.kind == FaultKind::kBounce || fault.place.part == FaultPart::kHost;
  const auto reference =
      looks_ahead ? run_reference(so_far, seed_) : std::make_unique<CaseRecord>();
  Injection injection;
  inject(fault, onset_ns, *reference, end_ns, injection);
  harness::finish(injection, fixture_.rig.parameters);
  return injection;
}

}  // namespace towbench::harness
