#include "harness/record/firmware_recorder.h"

#include "harness/record/event_lines.h"
#include "harness/record/log_columns.h"

namespace towbench::harness {

FirmwareRecorder::FirmwareRecorder(const std::filesystem::path& folder, Log log,
                                   const RecordedAxes& axes)
    : axes_(axes),
      log_(folder / "log.csv", log == Log::kPins ? pin_log_header() : log_header(axes)),
      timing_(folder / "timing.csv", "time_s,host_s,exchange_us"),
      events_(folder / kControllerEventsFile),
      console_(folder / "console.txt") {}

void FirmwareRecorder::row(const LogRow& row) noexcept {
  write_log_row(log_, row, axes_);
}

void FirmwareRecorder::event(const bbmc::SystemEvent& event) noexcept {
  events_.write(event_line(event));
}

void FirmwareRecorder::operator_acted(const OperatorAct& act) noexcept {
  events_.write(operator_act_line(act));
}

void FirmwareRecorder::wire_event(core::Nanoseconds time_ns, std::string_view kind) noexcept {
  events_.write(wire_event_line(time_ns, kind));
}

void FirmwareRecorder::timing(core::Nanoseconds time_ns, core::Nanoseconds host_ns,
                              core::Nanoseconds exchange_ns) noexcept {
  // Microseconds to the nanosecond: "3.25".
  timing_.time(time_ns).time(host_ns).time(exchange_ns * 1'000'000).end_row();
}

void FirmwareRecorder::flush() noexcept {
  log_.flush();
  timing_.flush();
  events_.flush();
  console_.flush();
}

}  // namespace towbench::harness
