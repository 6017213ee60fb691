#include "harness/fault_cases/case_link.h"

#include <algorithm>

namespace towbench::harness {
namespace {

[[nodiscard]] std::uint16_t enable_mask(core::Axis axis) noexcept {
  return protocol::mask_of(protocol::enable_line(axis));
}

}  // namespace

CaseLink::CaseLink(PlantEnd& plant, PeerControl& peer, const std::vector<LinkFault>& faults,
                   CaseRecord& record)
    : plant_(plant),
      peer_(peer),
      record_(record),
      to_plant_(*this, faults),
      to_controller_(*this, faults) {
  to_plant_.disturber.connect(plant.sink());
  std::copy_if(faults.begin(), faults.end(), std::back_inserter(blows_),
               [](const LinkFault& fault) { return may_end_run(fault.kind); });
}

void CaseLink::connect(protocol::MessageSink& controller) noexcept {
  witnessed_.emplace(witness_, controller);
  to_controller_.disturber.connect(*witnessed_);
  plant_.connect(to_controller_);
}

bool CaseLink::disturb(const LinkFault& fault) {
  if (may_end_run(fault.kind)) {
    blows_.push_back(fault);
  }
  to_plant_.disturber.add(fault);
  to_controller_.disturber.add(fault);
  return true;
}

void CaseLink::strike(core::Nanoseconds time_ns) noexcept {
  for (auto blow = blows_.begin(); blow != blows_.end() && !is_lost();) {
    if (time_ns < blow->from_ns) {
      ++blow;
      continue;
    }
    switch (blow->kind) {
      case FaultKind::kPeerKilled:
        lost_ = peer_.kill_peer();
        break;
      case FaultKind::kPeerRestart:
        lost_ = peer_.restart_peer();
        to_plant_.disturber.connect(plant_.sink());
        break;
      case FaultKind::kBusOff:
        lost_ = peer_.leave_bus();
        is_off_bus_ = true;
        break;
      default:
        break;  // strikes by itself: no turn is understood any more
    }
    blow = blows_.erase(blow);
  }
}

core::Status CaseLink::wait_for(protocol::Turn expected) noexcept {
  if (!is_lost()) {
    const auto heard = plant_.wait_for(expected);
    if (!heard) {
      return heard;
    }
  }
  return is_lost() ? core::Status(core::failure(lost_)) : core::Status();
}

// ---- controller to plant ----

void CaseLink::ToPlant::handle(const protocol::PwmDuty& duty) noexcept {
  const double net = static_cast<double>(duty.channel_a_ticks) - duty.channel_b_ticks;
  link.record_.sent({.time_ns = link.now_ns_,
                     .axis = duty.axis,
                     .duty = duty.period_ticks == 0 ? 0.0 : net / duty.period_ticks,
                     .enable = duty.enable});
  if (reverse && duty.axis == reverse->axis) {
    if (taken_over()) {
      return;
    }
    duty_sequence = duty.sequence;
    period_ticks = duty.period_ticks;
  }
  if (link.sends()) {
    disturber.pass(duty, link.now_ns_);
  }
}

void CaseLink::ToPlant::handle(const protocol::DigitalOutputs& outputs) noexcept {
  if (taken_over()) {
    return;
  }
  outputs_sequence = outputs.sequence;
  if (link.sends()) {
    disturber.pass(outputs, link.now_ns_);
  }
}

void CaseLink::ToPlant::drive_in_reverse() noexcept {
  const bool over = link.now_ns_ >= reverse->until_ns;
  const auto ticks = static_cast<std::uint16_t>(over ? 0.0 : reverse->duty * period_ticks);
  const bool to_max = reverse->direction > 0;
  auto& plant = link.plant_.sink();
  plant.on(protocol::DigitalOutputs{.lines = over ? std::uint16_t{0} : enable_mask(reverse->axis),
                                    .change_ns = link.now_ns_,
                                    .sequence = ++outputs_sequence});
  plant.on(protocol::PwmDuty{.axis = reverse->axis,
                             .enable = !over,
                             .channel_a_ticks = to_max ? ticks : std::uint16_t{0},
                             .channel_b_ticks = to_max ? std::uint16_t{0} : ticks,
                             .period_ticks = period_ticks,
                             .sequence = ++duty_sequence});
}

void CaseLink::ToPlant::handle(const protocol::Advance& advance) noexcept {
  if (taken_over()) {
    drive_in_reverse();
  }
  disturber.end_turn(link.now_ns_);
  link.until_ns_ = advance.until_ns;
  if (link.watcher_ != nullptr) {
    link.watcher_->runs_to(advance.until_ns);
  }
  link.strike(advance.until_ns);
  if (link.sends() && !disturber.pass_turn(advance, link.now_ns_)) {
    link.lost_ = core::ErrorCode::kPeerSilent;
  }
  link.now_ns_ = advance.until_ns;
}

// ---- plant to controller ----

void CaseLink::ToController::handle(const protocol::Advanced& advanced) noexcept {
  disturber.end_turn(link.until_ns_);
  link.record_.arrivals.push_back({link.until_ns_, link.witness_.digest});
  if (!disturber.pass_turn(advanced, link.until_ns_)) {
    link.lost_ = core::ErrorCode::kPeerSilent;
  }
}

void CaseLink::Witness::mix(std::uint64_t word) noexcept {
  digest = (digest ^ word) * 0x9e3779b97f4a7c15U;
  digest ^= digest >> 29U;
}

void CaseLink::Witness::on(const protocol::EncoderEdges& edges) noexcept {
  mix(static_cast<std::uint64_t>(edges.start_ns));
  mix(edges.start_levels | (static_cast<std::uint64_t>(edges.axis) << 8U));
  for (const protocol::EncoderEdge edge : edges.edges.view()) {
    mix(edge.packed());
  }
}

void CaseLink::Witness::on(const protocol::EncoderReport& report) noexcept {
  mix(static_cast<std::uint64_t>(report.last_edge_ns));
  mix(static_cast<std::uint32_t>(report.count_change));
  mix(report.capture_period_ns);
  mix(static_cast<std::uint32_t>(report.index_count));
  mix(report.levels | (static_cast<std::uint64_t>(report.axis) << 8U) |
      (static_cast<std::uint64_t>(report.index_pulses) << 16U) |
      (static_cast<std::uint64_t>(report.illegal_transitions) << 32U));
}

void CaseLink::Witness::on(const protocol::DigitalInputs& inputs) noexcept {
  mix(static_cast<std::uint64_t>(inputs.change_ns));
  mix(inputs.lines);
  link.record_.lines.push_back({link.until_ns_, inputs.change_ns, inputs.lines});
}

void CaseLink::Witness::on(const protocol::CurrentSample& sample) noexcept {
  mix(static_cast<std::uint64_t>(sample.time_ns));
}

}  // namespace towbench::harness
