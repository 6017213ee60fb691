#include "bbmc/host/linux/linux_node.h"

#include <vector>

#include "bbmc/application/application.h"
#include "bbmc/host/linux/drive_guard.h"
#include "bbmc/host/linux/linux_board.h"
#include "bbmc/system/system_manager.h"
#include "core/check.h"

namespace towbench::bbmc {

const char* inconsistency(const LinuxDevices& devices,
                          const Configuration& configuration) noexcept {
  if (devices.kill_switch.empty()) {
    return "kill_switch must be named";
  }
  for (core::Axis which : kAxes) {
    const AxisConfiguration& axis = configuration.axes[which];
    const LinuxAxis& wired = devices.axes[which];
    if (axis.exists != !wired.encoder.counter.empty()) {
      return "the controller's axes and those with an encoder.counter must be the same";
    }
    if (!axis.exists) {
      continue;
    }
    if (wired.hall_min.empty() || wired.hall_max.empty() || wired.amplifier_enable.empty() ||
        wired.pwm.towards_max.chip.empty() || wired.pwm.towards_min.chip.empty()) {
      return "an axis needs hall_min, hall_max, amplifier_enable and both PWM channels";
    }
    if (configuration.safety.amplifier_ready_fitted && wired.amplifier_ready.empty()) {
      return "the controller counts on amplifier_ready (safety.amplifier_ready_fitted)";
    }
    if (axis.plausibility.index_fitted && wired.encoder.index_events.empty()) {
      return "the controller judges the index (plausibility.index_fitted), but no index_events are "
             "named";
    }
  }
  return nullptr;
}

class LinuxNode::Implementation {
 public:
  Implementation(const Configuration& configuration, core::Nanoseconds origin_ns)
      : exchange_ns(exchange_period_ns(configuration.control_period_ns())),
        board(origin_ns),
        log_storage(kDataLogRows),
        devices(board.ports()),
        system(configuration, devices, log_storage),
        application(system, devices) {
    core::check(inconsistency(configuration) == nullptr);
  }

  core::Nanoseconds exchange_ns;
  LinuxBoard board;
  DriveGuard guard;
  bool guard_is_gone = false;
  std::vector<DataLogRow> log_storage;
  DeviceManager devices;
  SystemManager system;
  Application application;
};

LinuxNode::LinuxNode(const Configuration& configuration, core::Nanoseconds origin_ns)
    : implementation_(std::make_unique<Implementation>(configuration, origin_ns)) {}

LinuxNode::~LinuxNode() = default;

core::Status LinuxNode::start(const LinuxDevices& devices, core::Nanoseconds now_ns,
                              core::Nanoseconds patience_ns) {
  Implementation& self = *implementation_;
  auto status = self.board.open(devices);
  if (status) {
    status = self.system.start();
  }
  if (status) {
    status = self.board.sample(now_ns);
  }
  if (status) {
    status = self.board.flush();
  }
  if (status && patience_ns > 0) {
    status = self.guard.post(self.board, patience_ns);
  }
  if (!status) {
    self.board.make_safe();
  }
  return status;
}

bool LinuxNode::serve(core::Nanoseconds now_ns) noexcept {
  Implementation& self = *implementation_;
  core::Status status = self.board.sample(now_ns);
  if (self.guard.is_posted() && !self.guard.alive()) {
    self.guard_is_gone = true;
    status = core::failure(core::ErrorCode::kPeerClosed);
  }
  self.system.service(now_ns);
  if (status) {
    status = self.board.flush();
  }
  if (!status) {
    self.system.link_lost(core::ErrorCode::kFaultLinkLost);
    self.board.make_safe();
  }
  self.application.poll(now_ns);
  return status.has_value();
}

core::Nanoseconds LinuxNode::exchange_ns() const noexcept {
  return implementation_->exchange_ns;
}

std::string LinuxNode::trouble() const {
  return implementation_->guard_is_gone
             ? "the drive guard took the drive away: the controller was not served in time"
             : implementation_->board.trouble().message();
}

const SystemStatus& LinuxNode::status() const noexcept {
  return implementation_->system.status();
}

std::size_t LinuxNode::type(std::string_view bytes) noexcept {
  return implementation_->board.console().type(bytes);
}

std::size_t LinuxNode::read_console(std::span<char> into) noexcept {
  return implementation_->board.console().read_out(into);
}

bool LinuxNode::next_row(TelemetryRow& row) noexcept {
  return implementation_->system.next_row(row);
}

bool LinuxNode::next_event(SystemEvent& event) noexcept {
  return implementation_->system.next_event(event);
}

std::uint64_t LinuxNode::rows_lost() const noexcept {
  return implementation_->system.rows_lost();
}

bool LinuxNode::idle() const noexcept {
  Implementation& self = *implementation_;
  return self.system.at_rest() && self.application.idle() && !self.board.console().has_input();
}

bool LinuxNode::quit_requested() const noexcept {
  return implementation_->application.quit_requested();
}

void LinuxNode::finish() noexcept {
  implementation_->devices.close_all();
  implementation_->board.make_safe();
  implementation_->guard.dismiss();
}

}  // namespace towbench::bbmc
