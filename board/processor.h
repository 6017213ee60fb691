// The Cortex-A8 of the virtual board: Unicorn executes the instructions, this class gives it time,
// interrupts and an end.
//
// Time: every instruction takes kInstruction_ns, every access to a peripheral kPeripheralAccess_ns
// more. That is a round figure for compiled code out of warm caches at 1 GHz, not a timing model:
// what it is good for is order and repeatability. Interrupts are taken between basic blocks.
//
// Idle loops: a loop that comes round with the same registers, the same memory and no access that
// disturbs (bus.h) would do so until something happens; the caller is told and moves the clock.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "board/aintc.h"
#include "board/bus.h"
#include "board/cycle_counter.h"
#include "board/execution_profile.h"
#include "board/idle_detector.h"

struct uc_struct;

namespace towbench::board {

inline constexpr core::Nanoseconds kInstruction_ns = 2;
inline constexpr core::Nanoseconds kPeripheralAccess_ns = 100;

// Who answers an access to the peripherals' addresses; neither throws.
class PeripheralBus {
 public:
  PeripheralBus() = default;
  PeripheralBus(const PeripheralBus&) = delete;
  PeripheralBus& operator=(const PeripheralBus&) = delete;
  virtual ~PeripheralBus() = default;
  [[nodiscard]] virtual std::uint32_t load(std::uint32_t address, unsigned bytes) = 0;
  virtual void store(std::uint32_t address, unsigned bytes, std::uint32_t value) = 0;
};

enum class CrashKind : std::uint8_t {
  kUnmappedRead,
  kUnmappedWrite,
  kUnmappedFetch,
  kUndefinedInstruction,
  kAbort,
  kBreakpoint,
  kEmulator,  // Unicorn itself gave up
};

struct Crash {
  CrashKind kind = CrashKind::kEmulator;
  std::uint32_t address = 0;  // that was accessed
  std::uint32_t pc = 0;
  std::uint32_t link = 0;  // LR: where a jump may have come from
};

class Processor final : private RegisterReader {
 public:
  enum class Pause : std::uint8_t {
    kTime,       // the deadline has come
    kInterrupt,  // one is offered and not masked
    kWaiting,    // WFI
    kIdle,       // an idle loop
    kCrashed,
    kAgain,  // within run(): the block is to be translated with hooks in it
  };

  // All outlive this. Throws std::runtime_error when Unicorn cannot be set up.
  Processor(Bus& bus, Aintc& interrupts, PeripheralBus& peripherals, ExecutionProfile& profile);
  ~Processor() override;

  // Whole pages of 4 KiB; the largest memory first.
  void map_memory(std::uint32_t address, std::span<std::uint8_t> bytes);
  void map_peripherals(std::uint32_t address, std::uint32_t size);
  // The bytes there have changed under the processor.
  void forget_code(std::uint32_t address, std::uint32_t size);
  // What a loop that is taken for idle must not change.
  void watch_memory(std::vector<std::span<const std::uint8_t>> memory) {
    idle_.watch(std::move(memory));
  }

  // Supervisor mode, interrupts masked, MMU, caches and VFP off, as after reset; bit 0 of `entry`
  // is Thumb.
  void start(std::uint32_t entry);

  // Until something happens; the clock of the bus moves on.
  Pause run(core::Nanoseconds deadline_ns);
  // A peripheral's state has changed under the running program: look again by then.
  void hasten(core::Nanoseconds deadline_ns) noexcept {
    deadline_ns_ = deadline_ns < deadline_ns_ ? deadline_ns : deadline_ns_;
  }
  // The exception is taken. After kInterrupt, or after kWaiting when one is offered and unmasked.
  void take_interrupt();

  // Of the instruction that is making an access to this address.
  [[nodiscard]] std::uint32_t instruction_that_accesses(std::uint32_t address) const;
  // Of the last access to the performance monitor that is not modelled.
  [[nodiscard]] std::uint32_t doubtful_pc() const noexcept { return doubtful_pc_; }
  // For the engine, before such an instruction.
  void on_monitor_access(std::uint32_t address);

  [[nodiscard]] bool interrupts_masked() const;
  [[nodiscard]] std::uint32_t pc() const noexcept { return pc_; }
  [[nodiscard]] std::uint32_t stack_pointer() const;
  [[nodiscard]] const Crash& crash() const noexcept { return crash_; }

 private:
  struct Unicorn;

  void on_block(std::uint32_t address, std::uint32_t size);
  // A block that has never run.
  Block& meet(std::uint32_t address, std::uint32_t size);
  void on_exception(std::uint32_t number);
  void pause(Pause why);
  void fail(CrashKind kind, std::uint32_t address, std::uint32_t pc);
  void enter(std::uint32_t mode, std::uint32_t vector, std::uint32_t return_address);
  [[nodiscard]] std::uint32_t reg(int id) const;
  void set_reg(int id, std::uint32_t value);
  [[nodiscard]] RegisterSet registers() const override;
  [[nodiscard]] FloatRegisters float_registers() const override;
  [[nodiscard]] std::span<const std::uint8_t> stack_top() const override;
  // Whether a block holds instructions that reach the cycle counter, and that nobody has met.
  bool find_monitor_accesses(std::uint32_t address, std::uint32_t size, bool thumb);
  [[nodiscard]] std::uint32_t instruction_at(std::uint32_t address, bool thumb) const;
  [[nodiscard]] std::uint32_t code_word(std::uint32_t address) const;

  Bus& bus_;
  Aintc& interrupts_;
  PeripheralBus& peripherals_;
  ExecutionProfile& profile_;
  IdleDetector idle_;
  std::unique_ptr<Unicorn> unicorn_;
  uc_struct* engine_ = nullptr;  // its own
  std::uint32_t pc_ = 0;
  std::uint32_t block_ = 0;  // that executes
  std::uint32_t block_size_ = 0;
  core::Nanoseconds deadline_ns_ = 0;
  std::optional<Pause> paused_;
  std::uint32_t supervisor_return_ = 0;
  bool supervisor_call_ = false;
  bool monitor_call_ = false;
  CycleCounter counter_;
  std::set<std::uint32_t> watched_;  // instructions that reach it
  std::uint32_t doubtful_pc_ = 0;
  struct Memory {
    std::uint32_t address = 0;
    std::span<const std::uint8_t> bytes;
  };
  std::vector<Memory> memories_;
  Crash crash_;
};

}  // namespace towbench::board
