// The virtual board: an AM335x that executes a bare-metal image while the machine around it is
// stepped by somebody else.
//
// Its face are signals: encoder edges and pin levels in, shares of PWM and pin levels out, bytes of
// UART0 both ways. It knows neither plant nor controller. Everything is deterministic: the same
// image and the same signals give the same instructions.
//
// After load() it stands as the boot loader hands over: DDR ready, UART0 at 115,200 baud, PLLs
// locked, supervisor mode with interrupts masked, MMU, caches and VFP off.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "board/aintc.h"
#include "board/bus.h"
#include "board/dmtimer.h"
#include "board/elf_image.h"
#include "board/execution_profile.h"
#include "board/gpio.h"
#include "board/memory_map.h"
#include "board/processor.h"
#include "board/pwm_subsystem.h"
#include "board/uart.h"
#include "board/watchdog.h"

namespace towbench::board {

// Why the image cannot go on. Each is final until reset().
enum class BoardFailure : std::uint8_t {
  kUnmappedAccess,        // outside every known block
  kUndefinedInstruction,  // also a breakpoint or an abort
  kSpinsMasked,           // kSilence_ns with interrupts masked and no access to a peripheral
  kWaitsForNothing,       // kSilence_ns without access, and no interrupt is enabled
  kPollsWhatStands,       // kSilence_ns with nothing but reads of registers that are merely kept
  kEmulator,
};

// Virtual time without sign of life after which an image counts as hanging.
inline constexpr core::Nanoseconds kSilence_ns = core::kNanosecondsPerSecond;

struct BoardVerdict {
  BoardFailure failure = BoardFailure::kEmulator;
  core::Nanoseconds time_ns = 0;
  std::uint32_t pc = 0;
  std::string sentence;  // with address, program counter and the nearest symbol
};

struct StuckBit {
  std::uint32_t address = 0;  // of a 32-bit word
  unsigned bit = 0;
  bool high = false;
};

class Board final : private PeripheralBus {
 public:
  // Throws std::runtime_error when the CPU emulator cannot be set up.
  Board();
  ~Board() override;

  // Empty, or why the image cannot run here. Replaces what was loaded; does not change the time.
  [[nodiscard]] std::string load(ElfImage image);
  // Power-on reset: peripherals, processor, and the image's segments as in the file. The machine's
  // signals stay.
  void reset();
  // The supply is gone: nothing executes and every output is off until reset().
  void power_off();
  [[nodiscard]] bool is_on() const noexcept { return on_; }

  // Executes until `until_ns`, or until the image fails: then the verdict stands.
  void run_until(core::Nanoseconds until_ns);
  [[nodiscard]] core::Nanoseconds now_ns() const noexcept { return time_ns_; }
  [[nodiscard]] const std::optional<BoardVerdict>& verdict() const noexcept { return verdict_; }

  // Signals. n < 3 for subsystems, n < 4 for banks. Edges and changes may lie ahead of now_ns().
  [[nodiscard]] Eqep& encoder(unsigned n) noexcept { return pwm_[n]->encoder(); }
  [[nodiscard]] const Ehrpwm& pwm(unsigned n) const noexcept { return pwm_[n]->pwm(); }
  [[nodiscard]] Gpio& gpio(unsigned n) noexcept { return *gpios_[n]; }
  [[nodiscard]] Uart& uart() noexcept { return *uart_; }
  [[nodiscard]] Aintc& interrupts() noexcept { return *aintc_; }

  // A debugger's view. `memory` is empty where there is no RAM.
  [[nodiscard]] std::span<std::uint8_t> memory(std::uint32_t address, std::uint32_t size);
  [[nodiscard]] const ElfImage& image() const noexcept { return image_; }
  [[nodiscard]] const ExecutionProfile& profile() const noexcept { return profile_; }
  [[nodiscard]] const std::vector<std::string>& notes() const noexcept { return bus_.notes; }
  // Why what the image did proves nothing, in a sentence with address and program counter: it went
  // by a register that is merely kept. Empty: it has not.
  [[nodiscard]] const std::string& doubt() const noexcept { return doubt_; }
  [[nodiscard]] unsigned watchdog_resets() const noexcept { return watchdog_resets_; }
  [[nodiscard]] core::Nanoseconds idle_ns() const noexcept { return idle_ns_; }

  // Faults of the board.
  void stick(const StuckBit& bit) {
    stuck_.push_back(bit);
    idle_ = false;
  }
  void free_stuck_bits() {
    stuck_.clear();
    idle_ = false;
  }
  // Reads whose value a stuck bit has changed, so far.
  [[nodiscard]] std::uint64_t stuck_reads() const noexcept { return stuck_reads_; }

 private:
  struct Mapped {
    std::uint32_t address = 0;
    RegisterBlock* block = nullptr;
  };

  std::uint32_t load(std::uint32_t address, unsigned bytes) override;
  void store(std::uint32_t address, unsigned bytes, std::uint32_t value) override;

  void make_peripherals();
  void map(std::uint32_t address, RegisterBlock& block);
  [[nodiscard]] RegisterBlock* block_at(std::uint32_t address, std::uint32_t& offset) const;
  void copy_segments();
  void advance_all();
  [[nodiscard]] core::Nanoseconds next_event_ns() const;
  void skip_to(core::Nanoseconds time_ns);
  void watch_for_life();
  void fail(BoardFailure failure, std::uint32_t pc, std::string sentence);
  void fail_with_crash();
  [[nodiscard]] std::string at(std::uint32_t pc) const;
  [[nodiscard]] std::string name_of(std::uint32_t address) const;
  [[nodiscard]] std::uint32_t code_at(std::uint32_t address);
  [[nodiscard]] std::uint32_t as_stuck(std::uint32_t address, unsigned bytes, std::uint32_t value);

  Bus bus_;
  ExecutionProfile profile_;
  ElfImage image_;
  std::vector<std::unique_ptr<RegisterBlock>> owned_;
  std::vector<RegisterBlock*> moving_;  // those that change by themselves
  std::vector<Mapped> mapped_;
  Aintc* aintc_ = nullptr;
  Uart* uart_ = nullptr;
  Watchdog* watchdog_ = nullptr;
  std::array<Dmtimer*, 8> timers_{};
  std::array<Gpio*, kGpios.size()> gpios_{};
  std::array<PwmSubsystem*, kPwmSubsystems.size()> pwm_{};
  struct Ram {
    Place place;
    std::unique_ptr<std::uint8_t[], void (*)(void*)> bytes;
  };
  std::vector<Ram> rams_;
  std::unique_ptr<Processor> processor_;
  std::vector<StuckBit> stuck_;
  std::optional<BoardVerdict> verdict_;
  core::Nanoseconds time_ns_ = 0;
  core::Nanoseconds idle_ns_ = 0;
  bool on_ = false;
  bool started_ = false;
  bool waiting_ = false;  // in WFI
  bool idle_ = false;     // in a loop that goes round until something happens
  std::uint64_t stuck_reads_ = 0;
  std::string doubt_;
  unsigned watchdog_resets_ = 0;
  std::uint64_t signs_of_life_ = 0;  // accesses but to registers that are merely kept
  std::uint64_t life_seen_ = 0;
  std::uint32_t polled_ = 0;  // the last of those
  core::Nanoseconds polled_ns_ = 0;
  core::Nanoseconds last_access_ns_ = 0;
  core::Nanoseconds last_unmasked_ns_ = 0;
  core::Nanoseconds next_look_ns_ = 0;
};

}  // namespace towbench::board
