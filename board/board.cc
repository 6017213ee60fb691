#include "board/board.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "board/clock_control.h"
#include "board/control_module.h"
#include "board/kept_blocks.h"
#include "board/kept_registers.h"

namespace towbench::board {
namespace {

constexpr std::uint32_t kSelectSlowClock = 2;
constexpr core::Nanoseconds kLookEvery_ns = core::kNanosecondsPerMillisecond;

bool lies_in(const Place& place, std::uint32_t address, std::uint32_t size) noexcept {
  return address >= place.address && size <= place.size &&
         address - place.address <= place.size - size;
}

}  // namespace

Board::Board() {
  make_peripherals();
  processor_ =
      std::make_unique<Processor>(bus_, *aintc_, static_cast<PeripheralBus&>(*this), profile_);
  for (const Place& place : {kDdr, kOcmc, kSram}) {
    // Zero pages until they are touched.
    auto* bytes = static_cast<std::uint8_t*>(std::calloc(place.size, 1));
    if (bytes == nullptr) {
      throw std::bad_alloc();
    }
    rams_.push_back({place, {bytes, &std::free}});
    processor_->map_memory(place.address, {bytes, place.size});
  }
  for (const Mapped& mapped : mapped_) {
    processor_->map_peripherals(mapped.address, mapped.block->size());
  }
}

Board::~Board() = default;

void Board::map(std::uint32_t address, RegisterBlock& block) {
  mapped_.push_back({address, &block});
}

void Board::make_peripherals() {
  const auto own = [this](auto block) {
    auto* raw = block.get();
    owned_.push_back(std::move(block));
    return raw;
  };
  aintc_ = own(std::make_unique<Aintc>(bus_));
  map(kAintcAddress, *aintc_);
  const auto wire = [this](unsigned n) {
    return [this, n](bool raised) { aintc_->set_input(n, raised); };
  };
  for (const TimerPlace& place : kTimers) {
    auto* timer = own(std::make_unique<Dmtimer>(fmt::format("dmtimer{}", place.number), bus_,
                                                wire(place.interrupt)));
    timers_[place.number] = timer;
    map(place.address, *timer);
  }
  timers_[0]->set_clock(kSlowOscillator);
  for (const GpioPlace& place : kGpios) {
    auto* gpio = own(std::make_unique<Gpio>(fmt::format("gpio{}", place.number), bus_,
                                            [this, place](unsigned line, bool raised) {
                                              aintc_->set_input(place.interrupts[line], raised);
                                            }));
    gpios_[place.number] = gpio;
    map(place.address, *gpio);
  }
  for (const PwmPlace& place : kPwmSubsystems) {
    pwm_[place.number] = own(std::make_unique<PwmSubsystem>(
        place.number, bus_, wire(place.encoder_interrupt), wire(place.pwm_interrupt)));
    map(place.address, *pwm_[place.number]);
  }
  uart_ = own(std::make_unique<Uart>("uart0", bus_, wire(kUart0Interrupt)));
  map(kUart0Address, *uart_);
  map(kClockControlAddress,
      *own(std::make_unique<ClockControl>(bus_, [this](unsigned timer, std::uint32_t select) {
        timers_[timer]->set_clock(select == kSelectSlowClock ? kSlowOscillator : kMasterOscillator);
      })));
  map(kControlModuleAddress,
      *own(std::make_unique<ControlModule>(bus_, [this](std::uint32_t gates) {
        for (unsigned n = 0; n < pwm_.size(); ++n) {
          pwm_[n]->set_gate((gates >> n & 1U) != 0);
        }
      })));
  for (const KeptBlock& kept : kKeptBlocks) {
    map(kept.address, *own(std::make_unique<KeptRegisters>(kept.name, kept.size, bus_)));
  }
  watchdog_ = own(std::make_unique<Watchdog>("watchdog", kWatchdogSize, bus_));
  map(kWatchdogAddress, *watchdog_);
  for (const auto& block : owned_) {
    if (!block->is_configuration()) {
      moving_.push_back(block.get());
    }
  }
}

std::string Board::load(ElfImage image) {
  for (const ElfSegment& segment : image.segments()) {
    const bool fits = std::any_of(rams_.begin(), rams_.end(), [&](const Ram& ram) {
      return lies_in(ram.place, segment.address, segment.memory_size);
    });
    if (!fits) {
      return fmt::format(
          "a segment of {} bytes at 0x{:08x} lies outside the board's memory (0x{:08x} to "
          "0x{:08x}, and 128 KiB at 0x{:08x})",
          segment.memory_size, segment.address, kDdr.address, kDdr.address + kDdr.size - 1,
          kSram.address);
    }
  }
  if (memory(image.entry() & ~1U, 4).empty()) {
    return fmt::format("its entry point 0x{:08x} is not in memory", image.entry());
  }
  image_ = std::move(image);
  profile_.observe(image_);
  reset();
  return {};
}

std::span<std::uint8_t> Board::memory(std::uint32_t address, std::uint32_t size) {
  for (Ram& ram : rams_) {
    if (lies_in(ram.place, address, size)) {
      return {ram.bytes.get() + (address - ram.place.address), size};
    }
  }
  return {};
}

void Board::copy_segments() {
  std::vector<std::span<const std::uint8_t>> changing;
  for (const ElfSegment& segment : image_.segments()) {
    const auto target = memory(segment.address, segment.memory_size);
    std::copy(segment.bytes.begin(), segment.bytes.end(), target.begin());
    std::fill(target.begin() + static_cast<std::ptrdiff_t>(segment.bytes.size()), target.end(),
              std::uint8_t{0});
    changing.emplace_back(target);
    if (started_) {
      processor_->forget_code(segment.address, segment.memory_size);
    }
  }
  processor_->watch_memory(std::move(changing));
}

void Board::reset() {
  bus_.now_ns = time_ns_;
  for (auto& block : owned_) {
    block->reset();
  }
  timers_[0]->set_clock(kSlowOscillator);
  copy_segments();
  processor_->start(image_.entry());
  started_ = true;
  verdict_.reset();
  on_ = true;
  waiting_ = idle_ = false;
  profile_.restart();
  last_access_ns_ = last_unmasked_ns_ = next_look_ns_ = time_ns_;
}

void Board::power_off() {
  on_ = false;
  for (auto& block : owned_) {
    block->reset();
  }
}

RegisterBlock* Board::block_at(std::uint32_t address, std::uint32_t& offset) const {
  for (const Mapped& mapped : mapped_) {
    if (address >= mapped.address && address - mapped.address < mapped.block->size()) {
      offset = address - mapped.address;
      return mapped.block;
    }
  }
  return nullptr;
}

std::uint32_t Board::load(std::uint32_t address, unsigned bytes) {
  std::uint32_t offset = 0;
  RegisterBlock* const block = block_at(address, offset);
  if (block == nullptr) {
    return 0;
  }
  block->advance(bus_.now_ns);
  if (block->is_configuration()) {
    polled_ = address;
    polled_ns_ = bus_.now_ns;
  } else {
    ++signs_of_life_;
  }
  const std::uint32_t value = block->load(offset, bytes);
  if (!bus_.doubt.empty() && doubt_.empty()) {
    doubt_ = fmt::format("at {} the image goes by {} (0x{:08x}), which is not modelled",
                         at(processor_->instruction_that_accesses(address)), bus_.doubt, address);
  }
  return stuck_.empty() ? value : as_stuck(address, bytes, value);
}

std::uint32_t Board::as_stuck(std::uint32_t address, unsigned bytes, std::uint32_t value) {
  for (const StuckBit& stuck : stuck_) {
    const std::uint32_t first = stuck.address + stuck.bit / 8;
    if (first >= address && first < address + bytes) {
      const std::uint32_t bit = 1U << (8 * (first - address) + stuck.bit % 8);
      const std::uint32_t seen = stuck.high ? value | bit : value & ~bit;
      stuck_reads_ += seen != value ? 1U : 0U;
      value = seen;
    }
  }
  return value;
}

void Board::store(std::uint32_t address, unsigned bytes, std::uint32_t value) {
  std::uint32_t offset = 0;
  RegisterBlock* const block = block_at(address, offset);
  if (block == nullptr) {
    return;
  }
  block->advance(bus_.now_ns);
  ++signs_of_life_;
  block->store(offset, bytes, value);
  processor_->hasten(next_event_ns());
}

core::Nanoseconds Board::next_event_ns() const {
  core::Nanoseconds next_ns = kNever;
  for (const RegisterBlock* block : moving_) {
    next_ns = std::min(next_ns, block->next_event_ns());
  }
  return next_ns;
}

void Board::advance_all() {
  for (RegisterBlock* block : moving_) {
    block->advance(bus_.now_ns);
  }
}

void Board::skip_to(core::Nanoseconds time_ns) {
  if (time_ns > bus_.now_ns) {
    idle_ns_ += time_ns - bus_.now_ns;
    bus_.now_ns = time_ns;
  }
}

void Board::run_until(core::Nanoseconds until_ns) {
  while (on_ && !verdict_ && !watchdog_->expired() && bus_.now_ns < until_ns) {
    if (idle_) {
      skip_to(std::min(until_ns, next_event_ns()));
      idle_ = bus_.now_ns < next_event_ns();
      if (idle_) {
        break;  // the loop goes round until something happens
      }
    }
    advance_all();
    const core::Nanoseconds deadline_ns = std::min(until_ns, next_event_ns());
    if (waiting_ && !aintc_->offers()) {
      skip_to(std::max(deadline_ns, bus_.now_ns + 1));
      continue;
    }
    waiting_ = false;
    if (aintc_->offers() && !processor_->interrupts_masked()) {
      processor_->take_interrupt();
    }
    switch (processor_->run(deadline_ns)) {
      case Processor::Pause::kTime:
      case Processor::Pause::kInterrupt:
        break;
      case Processor::Pause::kWaiting:
        waiting_ = true;
        break;
      case Processor::Pause::kIdle:
        idle_ = true;
        break;
      case Processor::Pause::kCrashed:
        fail_with_crash();
        break;
      case Processor::Pause::kAgain:
        break;
    }
    if (!bus_.doubt.empty() && doubt_.empty()) {
      doubt_ = fmt::format("at {} the image goes by {}, which is not modelled",
                           at(processor_->doubtful_pc()), bus_.doubt);
    }
  }
  // The last block may have run a little past the end: the next call begins there.
  bus_.now_ns = std::max(bus_.now_ns, until_ns);
  time_ns_ = until_ns;
  advance_all();
  if (on_ && !verdict_ && watchdog_->expired()) {
    ++watchdog_resets_;
    reset();
  }
  if (on_ && !verdict_ && until_ns >= next_look_ns_) {
    next_look_ns_ = until_ns + kLookEvery_ns;
    idle_ = false;  // the loop goes round once more, and what it polls is seen
    watch_for_life();
  }
}

}  // namespace towbench::board
