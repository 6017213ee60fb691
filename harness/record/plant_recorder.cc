#include "harness/record/plant_recorder.h"

#include "harness/record/event_lines.h"

namespace towbench::harness {

PlantRecorder::PlantRecorder(const std::filesystem::path& folder,
                             const emulator::RigParameters& rig, RunTap* tap)
    : tap_(tap),
      truth_(folder / "truth.csv", truth_header(recorded_axes(rig.axes))),
      events_(folder / kPlantEventsFile),
      rows_(writer_, WriteTruth{&truth_, recorded_axes(rig.axes)}),
      sensors_(folder, rig, writer_) {}

PlantRecorder::~PlantRecorder() {
  flush();
}

void PlantRecorder::WriteTruth::operator()(
    std::span<const emulator::TruthRow> rows) const noexcept {
  for (const auto& row : rows) {
    write_truth_row(*csv, row, axes);
  }
}

void PlantRecorder::on_truth(const emulator::TruthRow& row) noexcept {
  rows_.add(row);
  for (const auto axis : core::kAllAxes) {
    sensors_.add(protocol::AbsoluteCount{
        .axis = axis, .time_ns = row.time_ns, .count = row.axes[axis].absolute_count});
  }
  if (tap_ != nullptr) {
    tap_->truth(row);
  }
}

void PlantRecorder::on_event(const emulator::PlantEvent& event) noexcept {
  // One a motor turn: the edges tell where it was, and a line each would drown the rest.
  if (event.kind != emulator::PlantEventKind::kIndexPulse) {
    const auto line = event_line(event);
    events_.write(line);
    events_.flush();
    if (tap_ != nullptr) {
      tap_->event(line);
    }
  }
}

void PlantRecorder::flush() noexcept {
  rows_.hand_over();
  sensors_.hand_over();
  writer_.wait();
  truth_.flush();
  sensors_.flush();
  events_.flush();
}

}  // namespace towbench::harness
