#include "emulator/plant_exchange.h"

#include "protocol/handshake.h"

namespace towbench::emulator {

using core::Axis;
using core::ErrorCode;

PlantExchange::PlantExchange(const RigParameters& rig, std::uint64_t seed,
                             std::span<const ScheduledEvent> events, PlantObserver& observer)
    : rig_(rig, seed),
      fixture_hash_(rig.fixture_hash),
      capabilities_(protocol::kCapabilityEdges | protocol::kCapabilityDigest |
                    protocol::kCapabilityReset |
                    (tells_counts(rig) ? protocol::kCapabilityAbsolute : 0U)),
      script_(events),
      observer_(&observer),
      faults_(observer),
      watch_(observer) {
  for (const Axis which : rig_.axes()) {
    if (const RigAxis* axis = rig_.axis(which)) {
      const protocol::EncoderLevels levels = axis->encoder().levels();
      outputs_[which].emplace(AxisOutputs{EdgeStream(which, levels), EncoderDigest(which, levels)});
    }
  }
}

// --- handshake -----------------------------------------------------------------------------------

protocol::Hello PlantExchange::own_hello(const protocol::Hello& theirs) const noexcept {
  return {.role = protocol::Role::kPlant,
          .axes_mask = rig_.axes_mask(),
          .tick_ns = static_cast<std::uint32_t>(core::kPlantTick_ns),
          .exchange_ns = theirs.exchange_ns,
          .capabilities = capabilities_,
          .fixture_hash = fixture_hash_};
}

void PlantExchange::greet(const protocol::Hello& hello) noexcept {
  if (finished_) {
    return;
  }
  if (greeted_) {
    // The controller has restarted: whatever the one before it commanded is void.
    remove_drive(ErrorCode::kPeerClosed);
  }
  forget_controller();
  protocol::HelloReply reply{.plant = own_hello(hello)};
  const core::Status agreed = protocol::compare(reply.plant, hello);
  reply.refusal = agreed ? ErrorCode::kNone : agreed.error();
  greeted_ = agreed.has_value();
  if (!greeted_) {
    observer_->on_refusal(reply.plant, hello, reply.refusal);
  }
  // Edges are the finer class; the digest is for a controller that asks for nothing else.
  sends_edges_ = (hello.capabilities & protocol::kCapabilityEdges) != 0;
  sends_digest_ = !sends_edges_;
  takes_reset_ = (hello.capabilities & protocol::kCapabilityReset) != 0;
  takes_absolute_ = (hello.capabilities & protocol::kCapabilityAbsolute) != 0;
  sink_->on(reply);
  if (greeted_) {
    sent_lines_ = rig_.lines();
    sink_->on(protocol::DigitalInputs{
        .lines = sent_lines_, .change_ns = now_ns(), .sequence = line_sequence_++});
    for (const Axis which : rig_.axes()) {
      send_absolute(which);
    }
  }
}

void PlantExchange::forget_controller() noexcept {
  line_sequence_ = 0;
  output_sequence_known_ = false;
  pending_lines_.clear();
  for (const Axis which : rig_.axes()) {
    if (RigAxis* axis = rig_.axis(which)) {
      axis->command.forget_sequence();
      outputs_[which]->edges.forget_sequence();
      outputs_[which]->digest.forget_sequence();
      outputs_[which]->absolute_sequence = 0;
    }
  }
}

// --- what the controller commands ----------------------------------------------------------------

void PlantExchange::drive(const protocol::PwmDuty& duty) noexcept {
  if (finished_) {
    return;
  }
  if (!greeted_) {
    report(ErrorCode::kProtocolNoHello, duty.axis, 0);
    return;
  }
  const bool known_axis = core::index_of(duty.axis) < core::kMostAxes;
  RigAxis* axis = known_axis ? rig_.axis(duty.axis) : nullptr;
  const ErrorCode verdict =
      axis != nullptr ? axis->command.accept(duty) : ErrorCode::kMessageBadField;
  if (verdict != ErrorCode::kNone) {
    report(verdict, known_axis ? duty.axis : core::kFirstAxis,
           static_cast<std::uint32_t>(duty.axis));
  }
}

void PlantExchange::set_outputs(const protocol::DigitalOutputs& outputs) noexcept {
  if (finished_) {
    return;
  }
  if (!greeted_) {
    report(ErrorCode::kProtocolNoHello, core::kFirstAxis, 0);
    return;
  }
  const std::uint32_t ahead = outputs.sequence - output_sequence_;
  if (output_sequence_known_ && ahead != 1) {
    report(ErrorCode::kSequence, core::kFirstAxis, outputs.sequence);
    if (ahead == 0 || ahead > 0x8000'0000U) {
      return;
    }
  }
  output_sequence_ = outputs.sequence;
  output_sequence_known_ = true;
  for (const Axis which : rig_.axes()) {
    if (RigAxis* axis = rig_.axis(which)) {
      axis->enable_line = (outputs.lines & protocol::mask_of(protocol::enable_line(which))) != 0;
      axis->brake_release_line =
          (outputs.lines & protocol::mask_of(protocol::brake_line(which))) != 0;
    }
  }
}

// --- one exchange --------------------------------------------------------------------------------

ErrorCode PlantExchange::objection(const protocol::Advance& advance) const noexcept {
  const core::Nanoseconds interval_ns = advance.until_ns - now_ns();
  if (!greeted_) {
    return ErrorCode::kProtocolNoHello;
  }
  if (advance.until_ns < now_ns()) {
    return ErrorCode::kTimeNotMonotonic;
  }
  return interval_ns > kMaxAdvance_ns || interval_ns % core::kPlantTick_ns != 0
             ? ErrorCode::kMessageBadField
             : ErrorCode::kNone;
}

void PlantExchange::advance(const protocol::Advance& advance) noexcept {
  if (finished_) {
    return;
  }
  if (const ErrorCode wrong = objection(advance); wrong != ErrorCode::kNone) {
    report(wrong, core::kFirstAxis, 0);
    return;
  }
  faults_.begin_exchange();
  if (advance.until_ns > now_ns()) {
    for (auto& output : outputs_) {
      if (output) {
        output->edges.begin(now_ns());
      }
    }
    while (now_ns() < advance.until_ns && failure().empty()) {
      tick();
    }
    if (!failure().empty()) {
      end_failed();
      return;
    }
    send_outputs();
    if (reset_ns_) {
      pass_reset(*reset_ns_);
      reset_ns_.reset();
    }
    observer_->on_truth(rig_.truth());
  }
  sink_->on(protocol::Advanced{.time_ns = now_ns()});
}

void PlantExchange::tick() noexcept {
  if (const auto reset_ns = script_.fire_due(rig_, *observer_)) {
    reset_ns_ = reset_ns;
  }
  const core::Nanoseconds start_ns = now_ns();
  rig_.step();
  for (const Axis which : rig_.axes()) {
    if (const RigAxis* axis = rig_.axis(which)) {
      AxisOutputs& output = *outputs_[which];
      if (sends_edges_) {
        output.edges.add(start_ns, axis->edges(), *sink_);
      } else {
        output.digest.add(start_ns, axis->edges());
      }
    }
  }
  if (!rig_.line_changes().empty()) {
    collect_lines();
  }
  send_samples();
  watch_.look(rig_, faults_);
}

void PlantExchange::send_samples() noexcept {
  for (const Axis which : rig_.axes()) {
    const RigAxis* axis = rig_.axis(which);
    if (axis != nullptr && axis->current_sample()) {
      observer_->on_current(*axis->current_sample());
      sink_->on(*axis->current_sample());
    }
  }
  if (rig_.camera_frame()) {
    observer_->on_frame(*rig_.camera_frame());
  }
  if (rig_.force_sample()) {
    observer_->on_force(*rig_.force_sample());
    sink_->on(*rig_.force_sample());
  }
}

void PlantExchange::send_outputs() noexcept {
  for (const Axis which : rig_.axes()) {
    auto& output = outputs_[which];
    if (output && sends_edges_) {
      output->edges.finish(now_ns(), *sink_);
    } else if (output && sends_digest_) {
      sink_->on(output->digest.take(now_ns()));
    }
    send_absolute(which);
  }
  send_lines();
}

void PlantExchange::send_absolute(Axis which) noexcept {
  const RigAxis* axis = rig_.axis(which);
  if (takes_absolute_ && axis != nullptr && axis->tells_count()) {
    sink_->on(protocol::AbsoluteCount{.axis = which,
                                      .time_ns = now_ns(),
                                      .count = axis->told_count(),
                                      .sequence = outputs_[which]->absolute_sequence++});
  }
}

void PlantExchange::send_lines() noexcept {
  for (const protocol::DigitalInputs& inputs : pending_lines_.view()) {
    sink_->on(inputs);
  }
  pending_lines_.clear();
}

void PlantExchange::pass_reset(core::Nanoseconds time_ns) noexcept {
  if (takes_reset_) {
    sink_->on(protocol::Reset{time_ns});
  }
  observer_->on_event({.time_ns = time_ns,
                       .kind = PlantEventKind::kOperatorReset,
                       .value = takes_reset_ ? 1.0 : 0.0});
}

void PlantExchange::collect_lines() noexcept {
  for (const LineChange& change : rig_.line_changes().view()) {
    const protocol::InputLines mask = protocol::mask_of(change.line);
    sent_lines_ = change.active ? sent_lines_ | mask : sent_lines_ & ~mask;
    if (pending_lines_.full()) {
      send_lines();  // early rather than lost; still in the order of time
    }
    (void)pending_lines_.push_back(
        {.lines = sent_lines_, .change_ns = change.time_ns, .sequence = line_sequence_++});
    observer_->on_event({.time_ns = change.time_ns,
                         .kind = PlantEventKind::kInputLineChanged,
                         .lines = sent_lines_,
                         .value = static_cast<double>(change.line)});
  }
}

// --- trouble and the end -------------------------------------------------------------------------

void PlantExchange::remove_drive(ErrorCode why) noexcept {
  rig_.remove_drive();
  observer_->on_event({.time_ns = now_ns(), .kind = PlantEventKind::kDriveRemoved, .code = why});
}

void PlantExchange::note_fault(const protocol::Fault& fault) noexcept {
  observer_->on_event({.time_ns = now_ns(), .kind = PlantEventKind::kFault, .code = fault.code});
}

void PlantExchange::end(const protocol::Bye& /*bye*/) noexcept {
  if (finished_) {
    return;
  }
  remove_drive(ErrorCode::kNone);
  finished_ = true;
  observer_->on_event({.time_ns = now_ns(), .kind = PlantEventKind::kFinished});
  sink_->on(protocol::Bye{.time_ns = now_ns()});
}

// Nobody is told that the time has come: what the machine did in it is not known.
void PlantExchange::end_failed() noexcept {
  report(ErrorCode::kForeignPlantFailed, core::kFirstAxis, 0);
  remove_drive(ErrorCode::kForeignPlantFailed);
  finished_ = true;
  sink_->on(protocol::Bye{.time_ns = now_ns()});
}

void PlantExchange::peer_lost(ErrorCode why) noexcept {
  if (finished_) {
    return;
  }
  observer_->on_event({.time_ns = now_ns(), .kind = PlantEventKind::kPeerLost, .code = why});
  remove_drive(why);
  greeted_ = false;
  finished_ = true;
}

}  // namespace towbench::emulator
