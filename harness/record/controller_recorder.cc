#include "harness/record/controller_recorder.h"

#include "harness/record/event_lines.h"

namespace towbench::harness {
namespace {

core::PerAxis<bbmc::EdgeTimes> edge_times_of(const bbmc::ControllerNode& controller) noexcept {
  core::PerAxis<bbmc::EdgeTimes> times{};
  for (const auto axis : bbmc::kAxes) {
    times[axis] = controller.edge_times(axis);
  }
  return times;
}
// There the kernel counts; nobody observes.
core::PerAxis<bbmc::EdgeTimes> edge_times_of(const bbmc::LinuxNode& /*controller*/) noexcept {
  return {};
}

}  // namespace

ControllerRecorder::ControllerRecorder(const std::filesystem::path& folder, RunTap* tap)
    : tap_(tap),
      log_(folder / "log.csv", log_header()),
      timing_(folder / "timing.csv", "time_s,host_s,exchange_us"),
      events_(folder / kControllerEventsFile),
      console_(folder / "console.txt"),
      log_rows_(writer_, WriteLog{&log_}),
      timing_rows_(writer_, WriteTiming{&timing_}) {}

ControllerRecorder::~ControllerRecorder() {
  flush();
}

void ControllerRecorder::WriteLog::operator()(
    std::span<const bbmc::TelemetryRow> rows) const noexcept {
  for (const auto& row : rows) {
    write_log_row(*csv, row);
  }
}

void ControllerRecorder::WriteTiming::operator()(std::span<const Timing> rows) const noexcept {
  for (const auto& row : rows) {
    // Microseconds to the nanosecond: "3.25".
    csv->time(row.time_ns).time(row.host_ns).time(row.exchange_ns * 1'000'000).end_row();
  }
}

template <typename Controller>
void ControllerRecorder::take_all(Controller& controller) noexcept {
  bbmc::TelemetryRow row;
  while (controller.next_row(row)) {
    log_rows_.add(row);
    if (tap_ != nullptr) {
      tap_->row(row, edge_times_of(controller));
    }
  }
  bbmc::ControllerEvent told;
  while (controller.next_event(told)) {
    event(event_line(told));
  }
}

void ControllerRecorder::event(const std::string& line) noexcept {
  events_.write(line);
  if (tap_ != nullptr) {
    tap_->event(line);
  }
}

void ControllerRecorder::console(std::string_view text) noexcept {
  console_.write(text);
  if (tap_ != nullptr && !text.empty()) {
    tap_->console(text);
  }
}

void ControllerRecorder::operator_acted(const OperatorAct& act) noexcept {
  event(operator_act_line(act));
}

void ControllerRecorder::drain(bbmc::ControllerNode& controller) noexcept {
  take_all(controller);
}

void ControllerRecorder::drain(bbmc::LinuxNode& controller) noexcept {
  take_all(controller);
}

void ControllerRecorder::wire_event(core::Nanoseconds time_ns, std::string_view kind) noexcept {
  event(wire_event_line(time_ns, kind));
}

void ControllerRecorder::timing(core::Nanoseconds time_ns, core::Nanoseconds host_ns,
                                core::Nanoseconds exchange_ns) noexcept {
  timing_rows_.add({time_ns, host_ns, exchange_ns});
  if (tap_ != nullptr) {
    tap_->exchange(exchange_ns);
  }
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
