#include "board/aintc.h"

#include <algorithm>
#include <limits>

namespace towbench::board {
namespace {

enum AintcRegister : std::uint32_t {
  kAintcSysStatus = 0x14,
  kSirIrq = 0x40,
  kSirFiq = 0x44,
  kAintcControl = 0x48,
  kIrqPriority = 0x60,
  kFiqPriority = 0x64,
  kThreshold = 0x68,
  kFirstBank = 0x80,
  kEndOfBanks = 0x100,
  kFirstLine = 0x100,
  kEndOfLines = 0x300,
};
enum BankRegister : std::uint32_t {
  kItr = 0x00,
  kMir = 0x04,
  kMirClear = 0x08,
  kMirSet = 0x0C,
  kIsrSet = 0x10,
  kIsrClear = 0x14,
  kPendingIrq = 0x18,
  kPendingFiq = 0x1C,
};
constexpr std::uint32_t kNewIrqAgreement = 1;

}  // namespace

Aintc::Aintc(Bus& bus) : RegisterBlock("aintc", 0x1000, bus) {
  Aintc::reset();
}

void Aintc::reset() {
  RegisterBlock::reset();
  forced_.fill(0);
  mask_.fill(0xFFFF'FFFFU);
  line_register_.fill(0);
  threshold_ = kNoThreshold;
  offered_ = -1;
  accepted_ = false;
  active_ = 0;
  active_priority_ = 0;
}

void Aintc::set_input(unsigned n, bool raised) {
  Fault& fault = faults_[n];
  if (fault.wanted == raised) {
    return;
  }
  fault.wanted = raised;
  if (raised && fault.lost > 0) {
    --fault.lost;
    ++fault.were_lost;
    return;
  }
  if (raised && fault.delay_ns > 0) {
    ++fault.were_late;
    fault.due_ns = bus().now_ns + fault.delay_ns;
    next_late_ns_ = std::min(next_late_ns_, fault.due_ns);
    return;
  }
  if (fault.due_ns != kNever) {
    fault.due_ns = kNever;
    find_next_late();
  }
  pass_on(n, raised);
}

void Aintc::pass_on(unsigned n, bool raised) {
  const std::uint32_t bit = 1U << (n % 32);
  std::uint32_t& bank = raised_[n / 32];
  bank = raised ? bank | bit : bank & ~bit;
  sort();
}

void Aintc::lose(unsigned n, unsigned count) noexcept {
  faults_[n].lost += count;
}

void Aintc::delay(unsigned n, core::Nanoseconds by_ns) noexcept {
  faults_[n].delay_ns = by_ns;
}

void Aintc::advance(core::Nanoseconds now_ns) {
  if (next_late_ns_ > now_ns) {
    return;
  }
  for (unsigned n = 0; n < kInputs; ++n) {
    if (faults_[n].due_ns <= now_ns) {
      faults_[n].due_ns = kNever;
      pass_on(n, faults_[n].wanted);
    }
  }
  find_next_late();
}

void Aintc::find_next_late() noexcept {
  next_late_ns_ = kNever;
  for (const Fault& fault : faults_) {
    next_late_ns_ = std::min(next_late_ns_, fault.due_ns);
  }
}

std::uint32_t Aintc::pending(unsigned bank) const noexcept {
  return (raised_[bank] | forced_[bank]) & ~mask_[bank];
}

unsigned Aintc::priority_of(unsigned n) const noexcept {
  return line_register_[n] >> 2U;
}

bool Aintc::anything_enabled() const noexcept {
  return std::any_of(mask_.begin(), mask_.end(),
                     [](std::uint32_t mask) { return mask != 0xFFFF'FFFFU; });
}

void Aintc::sort() {
  if (accepted_) {
    return;
  }
  offered_ = -1;
  unsigned best = std::numeric_limits<unsigned>::max();
  for (unsigned bank = 0; bank < kBanks; ++bank) {
    std::uint32_t bits = pending(bank);
    for (unsigned i = 0; bits != 0; ++i, bits >>= 1U) {
      const unsigned n = 32 * bank + i;
      const bool to_fiq = (line_register_[n] & 1U) != 0;
      const unsigned priority = priority_of(n);
      const bool passes = priority == 0 || threshold_ == kNoThreshold || priority < threshold_;
      if ((bits & 1U) != 0 && !to_fiq && passes && priority < best) {
        best = priority;
        offered_ = static_cast<int>(n);
      }
    }
  }
  if (offered_ >= 0) {
    active_ = static_cast<unsigned>(offered_);
    active_priority_ = best;
  }
}

void Aintc::accept() noexcept {
  accepted_ = true;
  offered_ = -1;
}

std::uint32_t Aintc::read_word(std::uint32_t offset, std::uint32_t /*lanes*/) {
  if (offset >= kFirstLine && offset < kEndOfLines) {
    return line_register_[(offset - kFirstLine) / 4];
  }
  if (offset >= kFirstBank && offset < kEndOfBanks) {
    const unsigned bank = (offset - kFirstBank) / 0x20;
    switch ((offset - kFirstBank) % 0x20) {
      case kItr:
        return raised_[bank] | forced_[bank];
      case kMir:
      case kMirClear:
      case kMirSet:
        return mask_[bank];
      case kIsrSet:
      case kIsrClear:
        return forced_[bank];
      case kPendingIrq:
        return pending(bank);
      default:
        return 0;
    }
  }
  switch (offset) {
    case kAintcSysStatus:
      return 1;
    case kSirIrq:
      return accepted_ || offered_ >= 0 ? active_ : kSpurious | active_;
    case kSirFiq:
      return kSpurious;
    case kIrqPriority:
      return accepted_ || offered_ >= 0 ? active_priority_ : 0xFFFF'FFC0U;
    case kFiqPriority:
      return 0xFFFF'FFC0U;
    case kThreshold:
      return threshold_;
    case kAintcControl:
      return 0;
    default:
      return stored(offset);
  }
}

void Aintc::write_word(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) {
  if (offset >= kFirstLine && offset < kEndOfLines) {
    const unsigned n = (offset - kFirstLine) / 4;
    if ((lanes & 0xFFU) != 0) {
      line_register_[n] = static_cast<std::uint8_t>(value);
    }
    if ((value & 1U) != 0) {
      note("aintc: an input is routed to FIQ, which is not modelled");
    }
  } else if (offset >= kFirstBank && offset < kEndOfBanks) {
    write_bank(offset, value, lanes);
  } else if (offset == kAintcControl) {
    if ((value & kNewIrqAgreement) != 0) {
      accepted_ = false;
    }
  } else if (offset == kThreshold) {
    if ((lanes & 0xFFU) != 0) {
      threshold_ = static_cast<std::uint8_t>(value);
    }
  } else if (offset == 0x10 && (value & 2U) != 0) {
    reset();
  } else {
    keep(offset, value, lanes);
  }
  sort();
}

void Aintc::write_bank(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) {
  const unsigned bank = (offset - kFirstBank) / 0x20;
  switch ((offset - kFirstBank) % 0x20) {
    case kMir:
      mask_[bank] = (mask_[bank] & ~lanes) | value;
      break;
    case kMirClear:
      mask_[bank] &= ~value;
      break;
    case kMirSet:
      mask_[bank] |= value;
      break;
    case kIsrSet:
      forced_[bank] |= value;
      break;
    case kIsrClear:
      forced_[bank] &= ~value;
      break;
    default:
      break;  // ITR and PENDING are read-only
  }
}

}  // namespace towbench::board
