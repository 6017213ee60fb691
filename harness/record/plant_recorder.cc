#include "harness/record/plant_recorder.h"

#include "harness/record/event_lines.h"
#include "harness/record/log_columns.h"

namespace towbench::harness {

PlantRecorder::PlantRecorder(const std::filesystem::path& folder)
    : truth_(folder / "truth.csv", truth_header()), events_(folder / kPlantEventsFile) {}

void PlantRecorder::on_truth(const emulator::TruthRow& row) noexcept {
  write_truth_row(truth_, row);
}

void PlantRecorder::on_event(const emulator::PlantEvent& event) noexcept {
  // One a motor turn: the edges tell where it was, and a line each would drown the rest.
  if (event.kind != emulator::PlantEventKind::kIndexPulse) {
    events_.write(event_line(event));
    events_.flush();
  }
}

void PlantRecorder::flush() noexcept {
  truth_.flush();
  events_.flush();
}

}  // namespace towbench::harness
