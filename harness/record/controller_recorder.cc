#include "harness/record/controller_recorder.h"

#include "harness/record/event_lines.h"
#include "harness/record/log_columns.h"

namespace towbench::harness {

ControllerRecorder::ControllerRecorder(const std::filesystem::path& folder)
    : log_(folder / "log.csv", log_header()),
      timing_(folder / "timing.csv", "time_s,host_s,exchange_us"),
      events_(folder / kControllerEventsFile),
      console_(folder / "console.txt") {}

void ControllerRecorder::drain(bbmc::ControllerNode& controller) noexcept {
  bbmc::TelemetryRow row;
  while (controller.next_row(row)) {
    write_log_row(log_, row);
  }
  bbmc::ControllerEvent event;
  while (controller.next_event(event)) {
    events_.write(event_line(event));
  }
}

void ControllerRecorder::wire_event(core::Nanoseconds time_ns, std::string_view kind) noexcept {
  events_.write(wire_event_line(time_ns, kind));
}

void ControllerRecorder::timing(core::Nanoseconds time_ns, core::Nanoseconds host_ns,
                                core::Nanoseconds exchange_ns) noexcept {
  timing_.time(time_ns).time(host_ns);
  // Microseconds to the nanosecond: "3.25".
  timing_.time(exchange_ns * 1'000'000).end_row();
}

void ControllerRecorder::flush() noexcept {
  log_.flush();
  timing_.flush();
  events_.flush();
  console_.flush();
}

bool ControllerRecorder::good() const noexcept {
  return log_.good() && timing_.good() && events_.good() && console_.good();
}

}  // namespace towbench::harness
