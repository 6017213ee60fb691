#include "harness/external/external_bench.h"

#include <cmath>

#include <fmt/format.h>

#include "emulator/rig_parameters.h"
#include "harness/external/reference_message.h"
#include "protocol/carriers/local_socket.h"

namespace towbench::harness {
namespace {

using core::Nanoseconds;

// The last position is held so long at the least.
constexpr Nanoseconds kHold_ns = core::kNanosecondsPerSecond / 2;
constexpr Nanoseconds kStandstill_ns = core::kNanosecondsPerSecond / 5;

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
                             FirmwareRecorder& recorder, CaseRecord* rows)
    : fixture_(fixture),
      plant_(plant),
      link_(link),
      recorder_(recorder),
      rows_(rows),
      schedule_(fixture.experiment.reference),
      to_plant_(*this, faults),
      to_controller_(*this, faults) {
  to_plant_.disturber.connect(plant_.node);
  to_controller_.disturber.connect(link_.peer());
  plant_.node.connect(to_controller_);
}

RunOutcome ExternalBench::run(const protocol::Hello& hello, const LoopWatchers& watchers) {
  const auto start = HostClock::now();
  advanced_ = start;
  wants_reference_ = (hello.capabilities & protocol::kCapabilityReference) != 0;
  outcome_.exchange_ns = hello.exchange_ns;
  outcome_.control_period_ns = hello.exchange_ns;
  to_plant_.on(hello);
  if (refusal_ != core::ErrorCode::kNone) {
    outcome_.reason = "handshake refused: " + told(refusal_);
  } else {
    outcome_.complete = true;
    exchange_until_over(watchers);
  }
  outcome_.end_ns = plant_.node.now_ns();
  outcome_.wall_time_s = std::chrono::duration<double>(HostClock::now() - start).count();
  return outcome_;
}

void ExternalBench::exchange_until_over(const LoopWatchers& watchers) {
  constexpr std::uint32_t kTurnsBetween = 4096;
  for (std::uint32_t turns = 1; !ended_; ++turns) {
    const auto turn = link_.wait(to_plant_);
    const auto lost = !turn           ? turn.error()
                      : time_stands() ? core::ErrorCode::kPeerSilent
                                      : core::ErrorCode::kNone;
    if (lost != core::ErrorCode::kNone || *turn == protocol::Turn::kBye) {
      const double now_s = core::seconds(plant_.node.now_ns());
      const bool ends = lost == core::ErrorCode::kNone;
      outcome_.script_failure =
          ends ? fmt::format("the controller ended the run at {} s", now_s)
               : fmt::format("the controller was lost at {} s: {}", now_s, told(lost));
      plant_.node.peer_lost(ends ? core::ErrorCode::kPeerClosed : lost);
      return;
    }
    if (watchers.stop != nullptr && watchers.stop->load(std::memory_order_relaxed)) {
      outcome_.complete = false;
      outcome_.reason = "interrupted";
      link_.peer().on(protocol::Bye{plant_.node.now_ns()});
      ended_ = true;
    }
    if (watchers.progress && turns % kTurnsBetween == 0) {
      watchers.progress(plant_.node.now_ns());
    }
  }
  // Its own Bye, where it sends one.
  (void)link_.wait(to_plant_);
}

bool ExternalBench::time_stands() {
  const auto host = HostClock::now();
  if (plant_.node.now_ns() != advanced_to_ns_) {
    advanced_to_ns_ = plant_.node.now_ns();
    advanced_ = host;
  }
  return host - advanced_ > std::chrono::nanoseconds(protocol::kDefaultSilence_ns);
}

void ExternalBench::note(const protocol::PwmDuty& duty) noexcept {
  commands_[duty.axis].duty = duty_of(duty);
}

// Ends the messages of a moment.
void ExternalBench::ToPlant::handle(const protocol::Advance& advance) noexcept {
  bench.plant_.heard.on(advance);
  const auto now_ns = bench.plant_.node.now_ns();
  if (advance.until_ns > now_ns && now_ns > bench.row_ns_) {
    bench.write_row(now_ns);
    bench.row_ns_ = now_ns;
  }
  disturber.end_turn(now_ns);
  bench.until_ns_ = advance.until_ns;
  bench.plant_.node.on(advance);
}

void ExternalBench::write_row(Nanoseconds time_ns) noexcept {
  bbmc::TelemetryRow row;
  row.time_ns = time_ns;
  for (const auto which : core::kAxes) {
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
  recorder_.row(row);
  if (rows_ != nullptr) {
    rows_->log.push_back(row);
  }
}

void ExternalBench::send_reference(Nanoseconds time_ns) noexcept {
  for (const auto which : core::kAxes) {
    if (fixture_.rig.parameters.axes[which].exists) {
      to_controller_.disturber.pass(reference_message(schedule_, which, time_ns), time_ns);
    }
  }
}

bool ExternalBench::over(Nanoseconds time_ns) noexcept {
  if (time_ns >= core::nanoseconds(fixture_.experiment.duration_limit_s)) {
    if (time_ns < schedule_.end_ns()) {
      outcome_.script_failure = "the time limit came before the reference's end";
    }
    return true;
  }
  const auto after_ns = time_ns - schedule_.end_ns();
  return after_ns >= kLongestSettling_ns ||
         (after_ns >= kHold_ns && plant_.standstill.stands_for_ns() >= kStandstill_ns);
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
  if (!bench.ended_) {
    bench.link_.peer().on(bye);
  }
}

}  // namespace towbench::harness
