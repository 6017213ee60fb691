#include "harness/fault_cases/case_record.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace towbench::harness {
namespace {

using emulator::AxisTruth;

// Bit for bit; padding does not count.
bool same(const AxisTruth& a, const AxisTruth& b) noexcept {
  const auto equal = [](double x, double y) { return std::memcmp(&x, &y, sizeof x) == 0; };
  return equal(a.motor_angle_rad, b.motor_angle_rad) &&
         equal(a.motor_speed_rad_per_s, b.motor_speed_rad_per_s) &&
         equal(a.carriage_m, b.carriage_m) &&
         equal(a.carriage_speed_m_per_s, b.carriage_speed_m_per_s) &&
         equal(a.current_A, b.current_A) && equal(a.command_V, b.command_V) &&
         a.edges_total == b.edges_total;
}

bool same(const KeptTruth& a, const KeptTruth& b) noexcept {
  return a.time_ns == b.time_ns && a.input_lines == b.input_lines &&
         std::all_of(core::kAllAxes.begin(), core::kAllAxes.end(),
                     [&](core::Axis axis) { return same(a.axes[axis], b.axes[axis]); });
}

// "reset" and "reset systate"; "reset poscalib" clears no fault.
bool resets(std::string_view line) noexcept {
  constexpr std::string_view kReset = "reset";
  if (!line.starts_with(kReset)) {
    return false;
  }
  line.remove_prefix(kReset.size());
  const auto word = line.find_first_not_of(' ');
  return word == std::string_view::npos || line.substr(word).starts_with("systate");
}

bool same(const Arrivals& a, const Arrivals& b) noexcept {
  return a.time_ns == b.time_ns && a.digest == b.digest;
}

template <typename Row>
core::Nanoseconds first_difference(const std::vector<Row>& a, const std::vector<Row>& b) noexcept {
  const std::size_t common = std::min(a.size(), b.size());
  for (std::size_t i = 0; i < common; ++i) {
    if (!same(a[i], b[i])) {
      return std::min(a[i].time_ns, b[i].time_ns);
    }
  }
  if (a.size() == b.size()) {
    return -1;
  }
  // One run ended earlier.
  return common == 0 ? 0 : a[common - 1].time_ns;
}

}  // namespace

void CaseRecord::drain(bbmc::ControllerNode& controller) noexcept {
  const bool is_off = host_ != nullptr && host_->ahead_ns(now_ns_) != 0;
  bbmc::TelemetryRow row;
  while (controller.next_row(row)) {
    row.time_ns = is_off ? now_ns_ : row.time_ns;
    log.push_back(row);
  }
  bbmc::ControllerEvent event;
  while (controller.next_event(event)) {
    // A line's edge has the machine's time.
    const bool by_clock = event.kind != bbmc::ControllerEvent::Kind::kLineEdge;
    event.time_ns = is_off && by_clock ? now_ns_ : event.time_ns;
    controller_events.push_back(event);
  }
}

void CaseRecord::console(std::string_view text) noexcept {
  if (!text.empty()) {
    printed.push_back({now_ns_, std::string(text)});
  }
}

void CaseRecord::typed(core::Nanoseconds time_ns, std::string_view text) noexcept {
  for (const char letter : text) {
    if (letter != '\n' && letter != '\r') {
      typing_ += letter;
    } else if (!typing_.empty()) {
      const auto heard_ns = host_ == nullptr ? time_ns : host_->next_served_ns(time_ns);
      typed_lines.push_back({heard_ns, std::move(typing_)});
      typing_.clear();
    }
  }
}

core::Nanoseconds CaseRecord::next_reset_ns(core::Nanoseconds from_ns) const noexcept {
  // The console answers within a few exchanges.
  constexpr core::Nanoseconds kAnswer_ns = 20 * core::kNanosecondsPerMillisecond;
  for (const auto& event : controller_events) {
    if (event.kind != bbmc::ControllerEvent::Kind::kReset || event.time_ns < from_ns) {
      continue;
    }
    const bool asked =
        std::any_of(typed_lines.begin(), typed_lines.end(), [&](const ConsoleText& line) {
          return resets(line.text) && line.time_ns <= event.time_ns &&
                 event.time_ns - line.time_ns <= kAnswer_ns;
        });
    if (asked) {
      return event.time_ns;
    }
  }
  return std::numeric_limits<core::Nanoseconds>::max();
}

void CaseRecord::on_event(const emulator::PlantEvent& event) noexcept {
  if (event.kind != emulator::PlantEventKind::kScheduledEventFired &&
      event.kind != emulator::PlantEventKind::kIndexPulse) {
    plant_events.push_back(event);
  }
}

const bbmc::ControllerEvent* CaseRecord::first_fault() const noexcept {
  const auto found = std::find_if(
      controller_events.begin(), controller_events.end(),
      [](const auto& event) { return event.kind == bbmc::ControllerEvent::Kind::kFaultLatched; });
  return found == controller_events.end() ? nullptr : &*found;
}

const KeptTruth& CaseRecord::truth_at(core::Nanoseconds time_ns) const noexcept {
  const auto after = std::upper_bound(
      truth.begin(), truth.end(), time_ns,
      [](core::Nanoseconds time, const KeptTruth& row) { return time < row.time_ns; });
  return after == truth.begin() ? truth.front() : *(after - 1);
}

void CaseRecord::sent(const DutyMessage& duty) {
  duties.push_back(duty);
  commanded_[duty.axis] = true;
}

bool CaseRecord::driven_at(core::Nanoseconds time_ns) const noexcept {
  auto later = std::upper_bound(
      duties.begin(), duties.end(), time_ns,
      [](core::Nanoseconds time, const DutyMessage& duty) { return time < duty.time_ns; });
  // The last that each axis was told.
  core::PerAxis<bool> told{};
  while (later != duties.begin() && !(told == commanded_)) {
    --later;
    if (!told[later->axis] && later->drives()) {
      return true;
    }
    told[later->axis] = true;
  }
  return false;
}

std::string CaseRecord::all_printed() const {
  std::string text;
  for (const auto& part : printed) {
    text += part.text;
  }
  return text;
}

core::Nanoseconds first_difference_ns(const CaseRecord& a, const CaseRecord& b) {
  const auto plant_ns = first_difference(a.truth, b.truth);
  const auto sensor_ns = first_difference(a.arrivals, b.arrivals);
  if (plant_ns < 0 || sensor_ns < 0) {
    return std::max(plant_ns, sensor_ns);
  }
  return std::min(plant_ns, sensor_ns);
}

}  // namespace towbench::harness
