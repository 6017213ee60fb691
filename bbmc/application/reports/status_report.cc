#include "bbmc/application/reports/report.h"
#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {
namespace {

std::string_view name_of_mode(AxisMode mode) noexcept {
  switch (mode) {
    case AxisMode::kIdle:
      return "idle";
    case AxisMode::kOpenLoop:
      return "open loop";
    case AxisMode::kPosition:
      return "position";
    case AxisMode::kVelocity:
      return "velocity";
    case AxisMode::kBraking:
      return "braking";
    case AxisMode::kFaulted:
      return "faulted";
  }
  return "unknown";
}

std::string_view yes_no(bool yes) noexcept {
  return yes ? "yes" : "no";
}

void write_machine(const SystemManager& system, TextWriter& out) noexcept {
  const SystemStatus& status = system.status();
  out.text("time ").fixed(core::seconds(status.time_ns), 3).text("s, control rate ");
  out.compact(system.configuration().control_rate_Hz, 3).text("Hz, ticks ");
  out.integer(static_cast<std::int64_t>(status.control_ticks)).text(", late ");
  out.integer(static_cast<std::int64_t>(status.late_ticks)).end_line();
  if (status.fault == core::ErrorCode::kNone) {
    out.text("fault: none");
  } else {
    out.text("fault: ").integer(core::number_of(status.fault)).text(" ");
    out.text(core::describe(status.fault)).text(" on ").text(core::name_of(status.fault_axis));
  }
  out.text(", kill switch ").text(status.kill_switch_pressed ? "pressed" : "released").end_line();
}

void write_axis(const SystemManager& system, core::Axis axis, TextWriter& out) noexcept {
  const AxisStatus& state = system.status().axes[axis];
  out.text("axis ").text(core::name_of(axis)).text(": ").text(name_of_mode(state.mode));
  out.text(", position ").integer(state.count).text(" counts = ").fixed(state.position_m, 6);
  out.text("m (").text(state.position_calibrated ? "calibrated" : "not calibrated").text(")");
  out.text(", since start ").integer(state.local_count).text(" counts").end_line();
  out.text("        speed ").fixed(state.velocity_m_per_s, 6).text("m/s, duty ");
  out.fixed(state.duty_pct, 1).text("%, amplifier enabled ").text(yes_no(state.amplifier_enabled));
  out.text(", ready ").text(yes_no(state.amplifier_ready)).end_line();
  out.text("        end-stop min ").text(state.hall_min_active ? "active" : "clear");
  out.text(", max ").text(state.hall_max_active ? "active" : "clear").text(", may go ");
  for (const int direction : {-1, 1}) {
    out.fixed(system.speed_allowed_m_per_s(axis, state.position_m, direction), 4);
    out.text(direction < 0 ? "m/s towards min, " : "m/s towards max");
  }
  out.end_line();
}

}  // namespace

bool StatusReport::next(const SystemManager& system, TextWriter& out) noexcept {
  while (part_ > 0 && part_ <= kAxisCount &&
         !system.configuration().axes[kAxes[part_ - 1]].exists) {
    ++part_;
  }
  if (part_ > kAxisCount) {
    return false;
  }
  if (part_ == 0) {
    write_machine(system, out);
  } else {
    write_axis(system, kAxes[part_ - 1], out);
  }
  ++part_;
  return true;
}

}  // namespace towbench::bbmc
