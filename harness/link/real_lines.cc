#include "harness/link/real_lines.h"

namespace towbench::harness {

void RealLinesAtController::ToPlant::handle(const protocol::DigitalOutputs& outputs) noexcept {
  if (const auto written = owner.port_.write(outputs.lines); !written && owner.status_) {
    owner.status_ = written;
  }
}

void RealLinesAtController::ToPlant::handle(const protocol::Advance& advance) noexcept {
  owner.until_ns_ = advance.until_ns;
  owner.plant_.sink().on(advance);
}

core::Status RealLinesAtController::wait_for(protocol::Turn expected) noexcept {
  const auto status = plant_.wait_for(expected);
  if (!status || expected != protocol::Turn::kAdvanced) {
    return status;
  }
  const auto levels = port_.read();
  if (!levels && status_) {
    status_ = core::failure(levels.error());
  }
  if (!status_) {
    return status_;
  }
  if (seen_ != levels->lines) {
    seen_ = levels->lines;
    to_controller_.to->on(protocol::DigitalInputs{
        .lines = levels->lines, .change_ns = until_ns_, .sequence = sequence_++});
  }
  return {};
}

void RealLinesAtPlant::In::handle(const protocol::Advance& advance) noexcept {
  const auto levels = owner.port_.read();
  if (!levels) {
    owner.status_ = core::failure(levels.error());
  } else if (owner.seen_ != levels->lines) {
    owner.seen_ = levels->lines;
    to.on(protocol::DigitalOutputs{
        .lines = levels->lines, .change_ns = owner.now_ns_, .sequence = owner.sequence_++});
  }
  owner.now_ns_ = advance.until_ns;
  to.on(advance);
}

void RealLinesAtPlant::Out::handle(const protocol::DigitalInputs& inputs) noexcept {
  if (const auto written = owner.port_.write(static_cast<std::uint16_t>(inputs.lines)); !written) {
    owner.status_ = written;
  }
}

}  // namespace towbench::harness
