#include "bbmc/host/emulated_ports.h"

#include "core/error.h"

namespace towbench::bbmc {

using core::ErrorCode;
using core::failure;
using core::Status;

// ---- ehrpwm ----

Status EmulatedPwm::apply(const Ehrpwm::Settings& settings) noexcept {
  settings_ = settings;
  output_ = {};
  written_ = true;
  return {};
}

Status EmulatedPwm::read(Ehrpwm::Reading& reading) noexcept {
  reading = output_;
  return {};
}

Status EmulatedPwm::write(const Ehrpwm::Command& command) noexcept {
  output_ = command;
  written_ = true;
  return {};
}

void EmulatedPwm::release() noexcept {
  output_ = {};
  written_ = true;
}

bool EmulatedPwm::take_written() noexcept {
  const bool was = written_;
  written_ = false;
  return was;
}

// ---- eqep ----

Status EmulatedEqep::apply(const Eqep::Settings& settings) noexcept {
  return decoder_.configure(settings) ? Status{} : failure(ErrorCode::kDeviceUnsupported);
}

Status EmulatedEqep::read(Eqep::Reading& reading) noexcept {
  reading = decoder_.read();
  return {};
}

Status EmulatedEqep::write(const Eqep::Command& command) noexcept {
  decoder_.load_position(command.position);
  return {};
}

// ---- dmtimer ----

Status EmulatedTimer::apply(const Dmtimer::Settings& settings) noexcept {
  // As auto-reload does: the new period begins with the next overflow.
  period_ns_ = settings.period_ns;
  return {};
}

Status EmulatedTimer::read(Dmtimer::Reading& reading) noexcept {
  reading = {
      .time_ns = clock_->now_ns, .next_due_ns = next_due_ns_, .ticks = ticks_, .running = running_};
  return {};
}

Status EmulatedTimer::write(const Dmtimer::Command& command) noexcept {
  switch (command.action) {
    case Dmtimer::Action::kStart:
      running_ = true;
      next_due_ns_ = clock_->now_ns;
      break;
    case Dmtimer::Action::kStop:
      running_ = false;
      break;
    case Dmtimer::Action::kAcknowledge:
      if (!running_) {
        return failure(ErrorCode::kDeviceNoData);
      }
      ++ticks_;
      next_due_ns_ += period_ns_;
      break;
  }
  return {};
}

// ---- gpio ----

void LineBank::insert(const Aintc::Reading& edge) noexcept {
  const auto before = [](const Aintc::Reading& a, const Aintc::Reading& b) {
    return a.time_ns != b.time_ns ? a.time_ns < b.time_ns
                                  : interrupt_priority_of(a.line) < interrupt_priority_of(b.line);
  };
  if (pending_count == kMaxPending) {
    // Room is made by the oldest edge that is not the kill switch's: levels tell the rest.
    std::size_t victim = kMaxPending;
    while (victim > 0 && pending[victim - 1].line == Line::kKillSwitch) {
      --victim;
    }
    if (victim == 0) {
      ++edges_dropped;
      return;
    }
    for (std::size_t i = victim - 1; i + 1 < pending_count; ++i) {
      pending[i] = pending[i + 1];
    }
    --pending_count;
    ++edges_dropped;
  }
  // Equal edges keep their order: the later one is served later, so it stands further in front.
  std::size_t place = pending_count;
  while (place > 0 && !before(edge, pending[place - 1])) {
    pending[place] = pending[place - 1];
    --place;
  }
  pending[place] = edge;
  ++pending_count;
}

Status EmulatedLine::apply(const Gpio::Settings& settings) noexcept {
  output_ = settings.output;
  bank_->interrupts_enabled =
      static_cast<std::uint16_t>(settings.interrupt_on_edges ? bank_->interrupts_enabled | mask_
                                                             : bank_->interrupts_enabled & ~mask_);
  if (output_) {
    return write({.active = false});
  }
  return {};
}

Status EmulatedLine::read(Gpio::Reading& reading) noexcept {
  reading.active = (bank_->levels & mask_) != 0;
  return {};
}

Status EmulatedLine::write(const Gpio::Command& command) noexcept {
  bank_->levels =
      static_cast<std::uint16_t>(command.active ? bank_->levels | mask_ : bank_->levels & ~mask_);
  bank_->outputs_written = true;
  return {};
}

void EmulatedLine::release() noexcept {
  if (output_) {
    static_cast<void>(write({.active = false}));
  }
  bank_->interrupts_enabled = static_cast<std::uint16_t>(bank_->interrupts_enabled & ~mask_);
}

// ---- aintc ----

Status EmulatedInterrupts::apply(const Aintc::Settings& settings) noexcept {
  threshold_ = settings.threshold;
  return {};
}

bool EmulatedInterrupts::served(const Aintc::Reading& edge) const noexcept {
  const std::uint8_t priority = interrupt_priority_of(edge.line);
  const bool masked = (masked_ & (1U << index_of(edge.line))) != 0;
  return edge.time_ns <= clock_->now_ns && !masked && (priority == 0 || priority < threshold_);
}

Status EmulatedInterrupts::read(Aintc::Reading& reading) noexcept {
  for (std::size_t i = bank_->pending_count; i-- > 0;) {
    if (served(bank_->pending[i])) {
      reading = bank_->pending[i];
      for (std::size_t k = i; k + 1 < bank_->pending_count; ++k) {
        bank_->pending[k] = bank_->pending[k + 1];
      }
      --bank_->pending_count;
      return {};
    }
  }
  return failure(ErrorCode::kDeviceNoData);
}

Status EmulatedInterrupts::write(const Aintc::Command& command) noexcept {
  const auto mask = static_cast<std::uint16_t>(1U << index_of(command.line));
  masked_ = static_cast<std::uint16_t>(command.action == Aintc::Action::kMask ? masked_ | mask
                                                                              : masked_ & ~mask);
  return {};
}

// ---- uart ----

Status EmulatedUart::apply(const Uart::Settings& /*settings*/) noexcept {
  return {};
}

Status EmulatedUart::read(Uart::Reading& reading) noexcept {
  reading.clear();
  char byte = 0;
  while (!reading.full() && received_.pop(byte)) {
    static_cast<void>(reading.push_back(byte));
  }
  return reading.empty() ? failure(ErrorCode::kDeviceNoData) : Status{};
}

Status EmulatedUart::write(const Uart::Command& command) noexcept {
  if (decltype(transmitted_)::capacity() - transmitted_.size() < command.size()) {
    return failure(ErrorCode::kDeviceFull);
  }
  for (const char byte : command.view()) {
    static_cast<void>(transmitted_.push(byte));
  }
  return {};
}

std::size_t EmulatedUart::type(std::string_view bytes) noexcept {
  std::size_t taken = 0;
  while (taken < bytes.size() && received_.push(bytes[taken])) {
    ++taken;
  }
  return taken;
}

std::size_t EmulatedUart::read_out(std::span<char> into) noexcept {
  std::size_t count = 0;
  while (count < into.size() && transmitted_.pop(into[count])) {
    ++count;
  }
  return count;
}

}  // namespace towbench::bbmc
