#include "bbmc/system/system_manager.h"

#include "bbmc/device/device_manager.h"
#include "bbmc/system/motion_check.h"
#include "core/check.h"

namespace towbench::bbmc {

using core::Axis;
using core::ErrorCode;

SystemManager::SystemManager(const Configuration& configuration, DeviceManager& devices,
                             std::span<DataLogRow> log_storage)
    : configuration_(configuration),
      exchange_ns_(exchange_period_ns(configuration.control_period_ns())),
      io_(devices),
      log_(log_storage),
      motion_(configuration, exchange_ns_, log_) {}

core::Status SystemManager::start() noexcept {
  return io_.start(configuration_);
}

// ---- the control path and what surrounds it ----

void SystemManager::service(core::Nanoseconds now_ns) noexcept {
  serve_interrupts();
  io_.sample(now_ns, sample_);
  core::check(samples_.push(sample_));

  ControlSample in;
  DriveCommand out;
  while (samples_.pop(in)) {
    motion_.exchange(in, line_edges_, out);
    core::check(commands_.push(out));
  }

  while (commands_.pop(out)) {
    io_.drive(out);
  }
  if (sample_.tick_due) {
    perf_.record(now_ns - sample_.tick_due_ns, io_.clock_ns() - now_ns);
  }
}

void SystemManager::serve_interrupts() noexcept {
  Aintc::Reading edge;
  while (line_edges_.size() < LineEdgeQueue::capacity() && io_.next_interrupt(edge)) {
    if (edge.line == Line::kKillSwitch && edge.active) {
      io_.remove_drive();  // before anything is computed
    }
    core::check(line_edges_.push(edge));
  }
}

void SystemManager::link_lost(ErrorCode why) noexcept {
  motion_.link_lost(why, motion_.status().time_ns);
  if (!motion_.braking()) {
    io_.remove_drive();
  }
}

// ---- what is known ----

const Configuration& SystemManager::configuration() const noexcept {
  return configuration_;
}
const SystemStatus& SystemManager::status() const noexcept {
  return motion_.status();
}
bool SystemManager::at_rest() const noexcept {
  return motion_.at_rest();
}

double SystemManager::speed_allowed_m_per_s(Axis axis, double position_m,
                                            int direction) const noexcept {
  return planned_speed_limit_m_per_s(motion_.axis(axis), position_m, direction);
}

DataLog& SystemManager::data_log() noexcept {
  return log_;
}
PerfLog& SystemManager::perf_log() noexcept {
  return perf_;
}
bool SystemManager::next_row(TelemetryRow& row) noexcept {
  return motion_.next_row(row);
}
bool SystemManager::next_event(SystemEvent& event) noexcept {
  return motion_.next_event(event);
}
std::uint64_t SystemManager::rows_lost() const noexcept {
  return motion_.lost();
}

}  // namespace towbench::bbmc
