#include "harness/external/external_bench.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "emulator/rig_parameters.h"
#include "harness/external/reference_message.h"
#include "harness/record/event_lines.h"
#include "protocol/carriers/local_socket.h"

namespace towbench::harness {
namespace {

using core::Nanoseconds;

// The last position is held so long at the least.
constexpr Nanoseconds kHold_ns = core::kNanosecondsPerSecond / 2;
constexpr Nanoseconds kStandstill_ns = core::kNanosecondsPerSecond / 5;
// More than any exchange needs by far.
constexpr std::uint32_t kMostMessages = 1000;

std::string told(core::ErrorCode code) {
  return fmt::format("{} ({})", core::describe(code), core::number_of(code));
}

double duty_of(const protocol::PwmDuty& duty) {
  const int ticks = int{duty.channel_a_ticks} - int{duty.channel_b_ticks};
  return duty.enable ? static_cast<double>(ticks) / duty.period_ticks : 0.0;
}

}  // namespace

ExternalBench::ExternalBench(const ExperimentFixture& fixture, const ExternalPlant& plant,
                             protocol::TurnLink& link, const std::vector<LinkFault>& faults,
                             const ExternalRecord& record, Operator* run_operator)
    : fixture_(fixture),
      plant_(plant),
      link_(link),
      record_(record),
      operator_(run_operator),
      schedule_(fixture.experiment.reference),
      to_plant_(*this, faults),
      to_controller_(*this, faults) {
  to_plant_.disturber.connect(plant_.node);
  to_controller_.disturber.connect(link_.peer());
  plant_.node.connect(to_controller_);
}

bool ExternalBench::greet(const protocol::Hello& hello) {
  wants_reference_ = (hello.capabilities & protocol::kCapabilityReference) != 0;
  outcome_.exchange_ns = hello.exchange_ns;
  outcome_.control_period_ns = hello.exchange_ns;
  to_plant_.on(hello);
  outcome_.complete = refusal_ == core::ErrorCode::kNone;
  outcome_.reason = outcome_.complete ? "" : "handshake refused: " + told(refusal_);
  return outcome_.complete;
}

RunOutcome ExternalBench::run(const protocol::Hello& hello, const LoopWatchers& watchers) {
  const auto start = HostClock::now();
  advanced_ = start;
  if (greet(hello)) {
    exchange_until_over(watchers);
  }
  return ended(start);
}

RunOutcome ExternalBench::ended(HostClock::time_point start) {
  outcome_.end_ns = plant_.node.now_ns();
  outcome_.wall_time_s = std::chrono::duration<double>(HostClock::now() - start).count();
  return outcome_;
}

void ExternalBench::lose(core::ErrorCode why, const std::string& words) {
  outcome_.script_failure =
      fmt::format("the controller {} at {:.4f} s{}",
                  why == core::ErrorCode::kNone ? "ended the run" : "was lost",
                  core::seconds(plant_.node.now_ns()), words);
  plant_.node.peer_lost(why == core::ErrorCode::kNone ? core::ErrorCode::kPeerClosed : why);
}

bool ExternalBench::said_too_much() {
  if (messages_ <= kMostMessages && !has_flooded_) {
    return false;
  }
  lose(core::ErrorCode::kTransportFailed,
       fmt::format(": it sent more than {} messages in one exchange", kMostMessages));
  link_.peer().on(protocol::Bye{plant_.node.now_ns()});
  return true;
}

void ExternalBench::interrupt_if_asked(const LoopWatchers& watchers) {
  if (watchers.stop != nullptr && watchers.stop->load(std::memory_order_relaxed)) {
    outcome_.complete = false;
    outcome_.reason = "interrupted";
    link_.peer().on(protocol::Bye{plant_.node.now_ns()});
    ended_ = true;
  }
}

void ExternalBench::exchange_until_over(const LoopWatchers& watchers) {
  constexpr std::uint32_t kTurnsBetween = 4096;
  auto host = advanced_;
  for (std::uint32_t turns = 1; !ended_; ++turns) {
    const auto turn = link_.wait(to_plant_);
    const auto lost = !turn           ? turn.error()
                      : time_stands() ? core::ErrorCode::kPeerSilent
                                      : core::ErrorCode::kNone;
    if (lost != core::ErrorCode::kNone || *turn == protocol::Turn::kBye) {
      lose(lost, lost == core::ErrorCode::kNone ? "" : ": " + told(lost));
      return;
    }
    if (said_too_much()) {
      return;
    }
    interrupt_if_asked(watchers);
    if (record_.tap != nullptr) {
      const auto before = std::exchange(host, HostClock::now());
      record_.tap->exchange(std::chrono::nanoseconds(host - before).count());
    }
    if (operator_ != nullptr && !ended_) {
      take_operator_acts(plant_.node.now_ns());
    }
    if (watchers.progress && turns % kTurnsBetween == 0) {
      watchers.progress(plant_.node.now_ns());
    }
  }
  // Its own Bye, where it sends one.
  (void)link_.wait(to_plant_);
}

void ExternalBench::take_operator_acts(Nanoseconds now_ns) {
  for (const auto& act : operator_->at(now_ns, *this)) {
    record_.recorder.operator_acted(act);
    if (record_.tap != nullptr) {
      record_.tap->event(operator_act_line(act));
    }
    finished_ = finished_ || act.kind == OperatorAct::Kind::kFinished;
    disturbed_ = disturbed_ || act.disturbs();
    // All that an operator has to say here; of a run that is repeated it is an event.
    if (act.kind == OperatorAct::Kind::kTyped && !is_planned(now_ns)) {
      plant_.node.add_event({.time_ns = now_ns, .kind = emulator::ScheduledEventKind::kReset});
    }
  }
  advanced_ = HostClock::now();  // an operator may have held the run
}

bool ExternalBench::is_planned(Nanoseconds reset_ns) const {
  const auto& events = fixture_.experiment.events;
  return std::any_of(events.begin(), events.end(), [&](const emulator::ScheduledEvent& event) {
    return event.kind == emulator::ScheduledEventKind::kReset && event.time_ns == reset_ns;
  });
}

bool ExternalBench::inject(const Injection& injection) {
  const auto& host = injection.host;
  if (!host.stalls.empty() || !host.steps.empty()) {
    return false;
  }
  for (const auto& event : injection.events) {
    plant_.node.add_event(event);
  }
  for (const auto& fault : injection.link) {
    to_plant_.disturber.add(fault);
    to_controller_.disturber.add(fault);
  }
  return true;
}

void ExternalBench::wait_a_little() noexcept {
  link_.peer().on(protocol::Heartbeat{plant_.node.now_ns(), heartbeats_++});
}

bool ExternalBench::time_stands() {
  const auto host = HostClock::now();
  if (plant_.node.now_ns() != advanced_to_ns_) {
    advanced_to_ns_ = plant_.node.now_ns();
    advanced_ = host;
  }
  return host - advanced_ > std::chrono::nanoseconds(protocol::kDefaultSilence_ns);
}

void ExternalBench::note_one() noexcept {
  ++messages_;
  if (answers_ != nullptr) {
    answers_->heard(plant_.node.now_ns());
  }
}

void ExternalBench::end_exchange() noexcept {
  has_flooded_ = has_flooded_ || messages_ > kMostMessages;
  messages_ = 0;
}

void ExternalBench::note(const protocol::PwmDuty& duty) noexcept {
  commands_[duty.axis].duty = duty_of(duty);
}

// Ends the messages of a moment.
void ExternalBench::ToPlant::handle(const protocol::Advance& advance) noexcept {
  bench.plant_.heard.on(advance);
  const auto now_ns = bench.plant_.node.now_ns();
  if (advance.until_ns > now_ns) {
    bench.end_exchange();
  }
  if (bench.answers_ != nullptr) {  // the plant keeps its own time
    bench.answers_->answered(advance.until_ns, now_ns);
    return;
  }
  const bool is_new = advance.until_ns > now_ns && now_ns > bench.row_ns_;
  const auto row = is_new ? bench.take_row(now_ns) : LogRow{};
  disturber.end_turn(now_ns);
  bench.until_ns_ = advance.until_ns;
  bench.plant_.node.on(advance);
  if (is_new) {  // the controller has its inputs and is at work meanwhile
    bench.record_.recorder.row(row);
    bench.row_ns_ = now_ns;
  }
}

LogRow ExternalBench::take_row(Nanoseconds time_ns) noexcept {
  LogRow row;
  row.time_ns = time_ns;
  for (const auto which : core::kAllAxes) {
    const auto& rig = fixture_.rig.parameters.axes[which];
    if (!rig.exists) {
      continue;
    }
    const double metres_per_count = emulator::metres_per_count(rig);
    const auto origin = std::llround(rig.start_m / metres_per_count);
    const auto& counter = counts_.of(which);
    const auto point = schedule_.at(which, time_ns);
    auto& axis = row.axes[which];
    const double half_a_count_m = metres_per_count / 2;
    axis.reference_m =
        static_cast<double>(origin) * metres_per_count + half_a_count_m + point.position_m;
    axis.reference_velocity_m_per_s = point.velocity_m_per_s;
    axis.count = origin + counter.count;
    axis.position_m = static_cast<double>(axis.count) * metres_per_count + half_a_count_m;
    axis.duty_pct = 100 * commands_[which].duty;
    axis.edges = static_cast<std::uint32_t>(counter.edges - commands_[which].edges_told);
    commands_[which].edges_told = counter.edges;
    axis.mode = schedule_.begun(which, time_ns) ? bbmc::AxisMode::kPosition : bbmc::AxisMode::kIdle;
  }
  if (record_.rows != nullptr) {
    record_.rows->log.push_back(row);
  }
  if (record_.tap != nullptr) {
    record_.tap->row(row, edges_.times());
  }
  return row;
}

void ExternalBench::send_reference(Nanoseconds time_ns) noexcept {
  for (const auto which : core::kAllAxes) {
    if (fixture_.rig.parameters.axes[which].exists) {
      to_controller_.disturber.pass(reference_message(schedule_, which, time_ns), time_ns);
    }
  }
}

bool ExternalBench::over(Nanoseconds time_ns) noexcept {
  const bool stands = plant_.standstill.stands_for_ns() >= kStandstill_ns;
  const bool ends_late = time_ns >= core::nanoseconds(fixture_.experiment.duration_limit_s);
  if (ends_late || (finished_ && stands)) {
    if (time_ns < schedule_.end_ns() && !disturbed_) {
      outcome_.script_failure = ends_late ? "the time limit came before the reference's end"
                                          : "finished by hand before the reference's end";
    }
    return true;
  }
  const auto after_ns = time_ns - schedule_.end_ns();
  const bool held = operator_ != nullptr && operator_->holds() && !finished_;
  return !held && (after_ns >= kLongestSettling_ns || (after_ns >= kHold_ns && stands));
}

void ExternalBench::ToController::handle(const protocol::HelloReply& reply) noexcept {
  auto ours = reply;
  ours.plant.capabilities |= protocol::kCapabilityReference;
  bench.refusal_ = reply.refusal;
  bench.link_.peer().on(ours);
}

// The last exchange is answered by Bye.
void ExternalBench::ToController::handle(const protocol::Advanced& advanced) noexcept {
  if (bench.over(advanced.time_ns)) {
    bench.ended_ = true;
    bench.link_.peer().on(protocol::Bye{advanced.time_ns});
    return;
  }
  if (bench.wants_reference_) {
    bench.send_reference(advanced.time_ns);
  }
  disturber.end_turn(advanced.time_ns);
  bench.link_.peer().on(advanced);
}

void ExternalBench::ToController::handle(const protocol::Bye& bye) noexcept {
  if (bench.ended_) {
    return;
  }
  if (const auto& why = bench.plant_.node.failure(); !why.empty()) {
    bench.outcome_.complete = false;
    bench.outcome_.reason = why;
    bench.ended_ = true;
  }
  bench.link_.peer().on(bye);
}

}  // namespace towbench::harness
