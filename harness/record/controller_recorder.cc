#include "harness/record/controller_recorder.h"

#include "harness/record/event_lines.h"

namespace towbench::harness {

ControllerRecorder::ControllerRecorder(const std::filesystem::path& folder)
    : log_(folder / "log.csv", log_header()),
      timing_(folder / "timing.csv", "time_s,host_s,exchange_us"),
      events_(folder / kControllerEventsFile),
      console_(folder / "console.txt"),
      log_rows_(writer_, WriteLog{&log_}),
      timing_rows_(writer_, WriteTiming{&timing_}) {}

ControllerRecorder::~ControllerRecorder() {
  flush();
}

void ControllerRecorder::WriteTiming::operator()(const Timing& timing) const noexcept {
  // Microseconds to the nanosecond: "3.25".
  csv->time(timing.time_ns).time(timing.host_ns).time(timing.exchange_ns * 1'000'000).end_row();
}

void ControllerRecorder::drain(bbmc::ControllerNode& controller) noexcept {
  bbmc::TelemetryRow row;
  while (controller.next_row(row)) {
    log_rows_.add(row);
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
  timing_rows_.add({time_ns, host_ns, exchange_ns});
}

void ControllerRecorder::flush() noexcept {
  log_rows_.hand_over();
  timing_rows_.hand_over();
  writer_.wait();
  log_.flush();
  timing_.flush();
  events_.flush();
  console_.flush();
}

bool ControllerRecorder::good() const noexcept {
  return log_.good() && timing_.good() && events_.good() && console_.good();
}

}  // namespace towbench::harness
