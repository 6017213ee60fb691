// How an image on the board comes to its end, and in which words.
#include <cstring>

#include <fmt/format.h>

#include "board/board.h"

namespace towbench::board {
namespace {

// In ARM state: coprocessors 10 and 11, or the space of Advanced SIMD (ARM ARM A5.4, A7).
bool is_vector_instruction(std::uint32_t code) noexcept {
  const bool is_coprocessor = (code & 0x0C00'0000U) == 0x0C00'0000U && (code & 0xE00U) == 0xA00U;
  const bool is_simd =
      (code & 0xFE00'0000U) == 0xF200'0000U || (code & 0xFF10'0000U) == 0xF400'0000U;
  return is_coprocessor || is_simd;
}

}  // namespace

std::uint32_t Board::code_at(std::uint32_t address) {
  std::uint32_t word = 0;
  if (const auto bytes = memory(address, sizeof word); !bytes.empty()) {
    std::memcpy(&word, bytes.data(), sizeof word);
  }
  return word;
}

std::string Board::name_of(std::uint32_t address) const {
  std::uint32_t offset = 0;
  const RegisterBlock* const block = block_at(address, offset);
  return fmt::format("register 0x{:x} of {}", offset, block == nullptr ? "?" : block->name());
}

void Board::watch_for_life() {
  const bool masked = processor_->interrupts_masked();
  if (signs_of_life_ != life_seen_) {
    life_seen_ = signs_of_life_;
    last_access_ns_ = time_ns_;
  }
  if (!masked) {
    last_unmasked_ns_ = time_ns_;
  }
  if (time_ns_ - last_access_ns_ < kSilence_ns) {
    return;
  }
  const std::uint32_t pc = processor_->pc();
  constexpr core::Nanoseconds kLately_ns = 10 * core::kNanosecondsPerMillisecond;
  const bool polls = polled_ != 0 && time_ns_ - polled_ns_ < kLately_ns;
  if (polls && (masked || !aintc_->anything_enabled())) {
    fail(BoardFailure::kPollsWhatStands, pc,
         fmt::format("the image hangs: at {} it has done nothing for {} s but read {}, which does "
                     "not change by itself here",
                     at(pc), core::seconds(kSilence_ns), name_of(polled_)));
  } else if (time_ns_ - last_unmasked_ns_ >= kSilence_ns && !waiting_) {
    fail(BoardFailure::kSpinsMasked, pc,
         fmt::format("the image hangs: it spins at {} with interrupts masked, and has touched no "
                     "peripheral for {} s",
                     at(pc), core::seconds(kSilence_ns)));
  } else if (!aintc_->anything_enabled()) {
    fail(BoardFailure::kWaitsForNothing, pc,
         fmt::format("the image hangs: at {} it has touched no peripheral for {} s, and no "
                     "interrupt is enabled that could wake it",
                     at(pc), core::seconds(kSilence_ns)));
  }
}

std::string Board::at(std::uint32_t pc) const {
  return fmt::format("0x{:08x} ({})", pc, image_.describe(pc));
}

void Board::fail(BoardFailure failure, std::uint32_t pc, std::string sentence) {
  verdict_ = BoardVerdict{failure, bus_.now_ns, pc, std::move(sentence)};
  for (PwmSubsystem* subsystem : pwm_) {
    subsystem->advance(bus_.now_ns);
  }
}

void Board::fail_with_crash() {
  const Crash& crash = processor_->crash();
  const auto told = [&](BoardFailure failure, const std::string& what) {
    fail(failure, crash.pc, fmt::format("the image stopped at {}: {}", at(crash.pc), what));
  };
  switch (crash.kind) {
    case CrashKind::kUnmappedRead:
    case CrashKind::kUnmappedWrite:
      told(BoardFailure::kUnmappedAccess,
           fmt::format("it {} 0x{:08x}, where the board has nothing",
                       crash.kind == CrashKind::kUnmappedRead ? "reads" : "writes", crash.address));
      break;
    case CrashKind::kUnmappedFetch:
      told(BoardFailure::kUnmappedAccess,
           fmt::format("it jumped there, and the board has no memory there; LR is {}",
                       at(crash.link)));
      break;
    case CrashKind::kUndefinedInstruction:
      told(BoardFailure::kUndefinedInstruction,
           is_vector_instruction(code_at(crash.pc))
               ? "undefined instruction (of VFP or NEON: are CPACR and FPEXC set?)"
               : "undefined instruction");
      break;
    case CrashKind::kBreakpoint:
      told(BoardFailure::kUndefinedInstruction, "breakpoint, and no debugger is there");
      break;
    case CrashKind::kAbort:
      told(BoardFailure::kUndefinedInstruction, "data or prefetch abort");
      break;
    case CrashKind::kEmulator:
      told(BoardFailure::kEmulator, fmt::format("the CPU emulator gave up ({})", crash.address));
      break;
  }
}

}  // namespace towbench::board
