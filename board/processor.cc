#include "board/processor.h"

#include <algorithm>
#include <stdexcept>
#include <unordered_map>

#include <fmt/format.h>
#include <unicorn/unicorn.h>

#include "board/thumb_length.h"
#include "board/unicorn_store_path.h"

namespace towbench::board {
namespace {

constexpr std::uint32_t kModeSupervisor = 0x13;
constexpr std::uint32_t kModeInterrupt = 0x12;
constexpr std::uint32_t kModeMask = 0x1F;
constexpr std::uint32_t kThumb = 1U << 5U;
constexpr std::uint32_t kInterruptsOff = 1U << 7U;
constexpr std::uint32_t kFastInterruptsOff = 1U << 6U;
constexpr std::uint32_t kAbortsOff = 1U << 8U;
constexpr std::uint32_t kIfThenState = 0x0600'FC00U;
constexpr std::uint32_t kInterruptVector = 0x18;
constexpr std::uint32_t kSupervisorVector = 0x08;
constexpr std::uint32_t kNowhere = 0xFFFF'FFF0U;  // where uc_emu_start would end by itself
// QEMU's numbers of exceptions, as UC_HOOK_INTR passes them on.
constexpr std::uint32_t kUndefined = 1;
constexpr std::uint32_t kSupervisorCall = 2;
constexpr std::uint32_t kPrefetchAbort = 3;
constexpr std::uint32_t kDataAbort = 4;
constexpr std::uint32_t kBreakpointException = 7;
constexpr std::uint32_t kHypervisorCall = 11;
constexpr std::uint32_t kMonitorCall = 13;

void must(uc_err error, const char* what) {
  if (error != UC_ERR_OK) {
    throw std::runtime_error(fmt::format("unicorn: {}: {}", what, uc_strerror(error)));
  }
}

}  // namespace

struct Processor::Unicorn {
  uc_engine* engine = nullptr;
  Processor* owner = nullptr;
  std::vector<uc_hook> hooks;
  struct Region {
    Processor* owner;
    std::uint32_t base;
  };
  std::vector<std::unique_ptr<Region>> regions;
  std::unique_ptr<StorePath> stores;

  ~Unicorn() { uc_close(engine); }

  static void block(uc_engine* /*uc*/, std::uint64_t address, std::uint32_t size, void* owner) {
    static_cast<Processor*>(owner)->on_block(static_cast<std::uint32_t>(address), size);
  }
  static void exception(uc_engine* /*uc*/, std::uint32_t number, void* owner) {
    static_cast<Processor*>(owner)->on_exception(number);
  }
  static bool invalid(uc_engine* /*uc*/, void* owner) {
    auto* self = static_cast<Processor*>(owner);
    self->fail(CrashKind::kUndefinedInstruction, 0, self->reg(UC_ARM_REG_PC));
    return false;
  }
  static bool unmapped(uc_engine* /*uc*/, uc_mem_type type, std::uint64_t address, int /*size*/,
                       std::int64_t /*value*/, void* owner) {
    auto* self = static_cast<Processor*>(owner);
    const auto where = static_cast<std::uint32_t>(address);
    if (type == UC_MEM_FETCH_UNMAPPED) {
      self->fail(CrashKind::kUnmappedFetch, where, where);
    } else {
      self->fail(
          type == UC_MEM_READ_UNMAPPED ? CrashKind::kUnmappedRead : CrashKind::kUnmappedWrite,
          where, self->instruction_that_accesses(where));
    }
    return false;
  }
  static std::uint64_t load(uc_engine* /*uc*/, std::uint64_t offset, unsigned size, void* user) {
    const auto* region = static_cast<Region*>(user);
    Processor& self = *region->owner;
    self.bus_.now_ns += kPeripheralAccess_ns;
    ++self.bus_.accesses;
    return self.peripherals_.load(region->base + static_cast<std::uint32_t>(offset), size);
  }
  static void store(uc_engine* /*uc*/, std::uint64_t offset, unsigned size, std::uint64_t value,
                    void* user) {
    const auto* region = static_cast<Region*>(user);
    Processor& self = *region->owner;
    self.bus_.now_ns += kPeripheralAccess_ns;
    ++self.bus_.accesses;
    self.peripherals_.store(region->base + static_cast<std::uint32_t>(offset), size,
                            static_cast<std::uint32_t>(value));
  }

  template <typename Function>
  void add_hook(int type, Function function) {
    uc_hook hook{};
    // Unicorn takes every kind of hook as an untyped pointer.
    must(uc_hook_add(engine, &hook, type, reinterpret_cast<void*>(function), owner, 1, 0), "hook");
    hooks.push_back(hook);
  }
};

Processor::Processor(Bus& bus, Aintc& interrupts, PeripheralBus& peripherals,
                     ExecutionProfile& profile)
    : bus_(bus),
      interrupts_(interrupts),
      peripherals_(peripherals),
      profile_(profile),
      unicorn_(std::make_unique<Unicorn>()) {
  unicorn_->owner = this;
  must(uc_open(UC_ARCH_ARM, UC_MODE_ARM, &unicorn_->engine), "open");
  engine_ = unicorn_->engine;
  must(uc_ctl_set_cpu_model(unicorn_->engine, UC_CPU_ARM_CORTEX_A8), "Cortex-A8");
  unicorn_->add_hook(UC_HOOK_BLOCK, &Unicorn::block);
  unicorn_->add_hook(UC_HOOK_INTR, &Unicorn::exception);
  unicorn_->add_hook(UC_HOOK_INSN_INVALID, &Unicorn::invalid);
  unicorn_->add_hook(UC_HOOK_MEM_UNMAPPED, &Unicorn::unmapped);
}

Processor::~Processor() = default;

void Processor::set_reg(int id, std::uint32_t value) {
  uc_reg_write(unicorn_->engine, id, &value);
}

void Processor::map_memory(std::uint32_t address, std::span<std::uint8_t> bytes) {
  memories_.push_back({address, bytes});
  must(uc_mem_map_ptr(unicorn_->engine, address, bytes.size(), UC_PROT_ALL, bytes.data()),
       "memory");
  if (unicorn_->stores == nullptr) {
    unicorn_->stores =
        std::make_unique<StorePath>(address, static_cast<std::uint32_t>(bytes.size()));
  }
}

// Flushing everything would clear Unicorn's whole code buffer, which is a gigabyte.
void Processor::forget_code(std::uint32_t address, std::uint32_t size) {
  uc_ctl_remove_cache(unicorn_->engine, address, static_cast<std::uint64_t>(address) + size);
}

void Processor::map_peripherals(std::uint32_t address, std::uint32_t size) {
  unicorn_->regions.push_back(std::make_unique<Unicorn::Region>(Unicorn::Region{this, address}));
  void* region = unicorn_->regions.back().get();
  must(
      uc_mmio_map(unicorn_->engine, address, size, &Unicorn::load, region, &Unicorn::store, region),
      "peripherals");
}

void Processor::start(std::uint32_t entry) {
  constexpr std::array kGeneral{UC_ARM_REG_R0, UC_ARM_REG_R1, UC_ARM_REG_R2,  UC_ARM_REG_R3,
                                UC_ARM_REG_R4, UC_ARM_REG_R5, UC_ARM_REG_R6,  UC_ARM_REG_R7,
                                UC_ARM_REG_R8, UC_ARM_REG_R9, UC_ARM_REG_R10, UC_ARM_REG_R11,
                                UC_ARM_REG_R12};
  set_reg(UC_ARM_REG_CPSR, kModeSupervisor | kInterruptsOff | kFastInterruptsOff | kAbortsOff);
  for (const int id : kGeneral) {
    set_reg(id, 0);
  }
  const auto write_coprocessor = [this](std::uint32_t crn, std::uint32_t op2, std::uint64_t value) {
    uc_arm_cp_reg cp{};
    cp.cp = 15;
    cp.crn = crn;
    cp.opc2 = op2;
    cp.val = value;
    uc_reg_write(unicorn_->engine, UC_ARM_REG_CP_REG, &cp);
  };
  write_coprocessor(12, 0, 0);           // VBAR
  write_coprocessor(1, 0, 0x00C5'0078);  // SCTLR of the Cortex-A8 after reset
  set_reg(UC_ARM_REG_FPEXC, 0);
  profile_.forget_blocks();
  counter_.reset();
  pc_ = entry;
  crash_ = {};
  idle_.restart();
}

bool Processor::interrupts_masked() const {
  return (reg(UC_ARM_REG_CPSR) & kInterruptsOff) != 0;
}

std::uint32_t Processor::stack_pointer() const {
  return reg(UC_ARM_REG_SP);
}

void Processor::pause(Pause why) {
  paused_ = why;
  uc_emu_stop(unicorn_->engine);
}

void Processor::fail(CrashKind kind, std::uint32_t address, std::uint32_t pc) {
  if (paused_ != Pause::kCrashed) {
    crash_ = {kind, address, pc, reg(UC_ARM_REG_LR)};
    paused_ = Pause::kCrashed;
  }
}

void Processor::on_block(std::uint32_t address, std::uint32_t size) {
  if (paused_) {
    return;
  }
  // Before the next interrupt is taken here: it would come back to the same place.
  while (profile_.may_leave(address) && profile_.left(stack_pointer())) {
  }
  if (bus_.now_ns >= deadline_ns_) {
    pause(Pause::kTime);
    return;
  }
  if (interrupts_.offers() && !interrupts_masked()) {
    pause(Pause::kInterrupt);
    return;
  }
  if (idle_.at_block(address, bus_.disturbances, *this)) {
    pause(Pause::kIdle);
    return;
  }
  Block* block = profile_.block_at(address, size);
  if (block == nullptr) {
    const bool thumb = (reg(UC_ARM_REG_CPSR) & kThumb) != 0;
    if (find_monitor_accesses(address, size, thumb)) {
      block_ = address;
      block_size_ = size;
      pause(Pause::kAgain);
      return;
    }
    block = &meet(address, size);
  }
  block_ = address;
  block_size_ = size;
  profile_.ran(*block);
  bus_.now_ns += kInstruction_ns * block->instructions;
}

Block& Processor::meet(std::uint32_t address, std::uint32_t size) {
  const bool thumb = (reg(UC_ARM_REG_CPSR) & kThumb) != 0;
  const auto read = [this](std::uint32_t at) { return code_word(at); };
  unicorn_->stores->code_at(address, size);
  return profile_.new_block(address, size,
                            thumb ? thumb_instructions(address, size, read) : size / 4);
}

void Processor::on_exception(std::uint32_t number) {
  const std::uint32_t pc = reg(UC_ARM_REG_PC);
  switch (number) {
    case kSupervisorCall:
      supervisor_call_ = true;
      supervisor_return_ = pc;
      break;
    case kMonitorCall:
    case kHypervisorCall:
      // The services of the ROM's monitor set up caches: nothing that this board has.
      monitor_call_ = true;
      break;
    case kUndefined:
      fail(CrashKind::kUndefinedInstruction, 0, pc);
      break;
    case kBreakpointException:
      fail(CrashKind::kBreakpoint, 0, pc);
      break;
    case kPrefetchAbort:
    case kDataAbort:
      fail(CrashKind::kAbort, 0, pc);
      break;
    default:
      fail(CrashKind::kEmulator, number, pc);
  }
  uc_emu_stop(unicorn_->engine);
}

Processor::Pause Processor::run(core::Nanoseconds deadline_ns) {
  deadline_ns_ = deadline_ns;
  idle_.restart();  // what was waited for may have come
  while (true) {
    paused_.reset();
    supervisor_call_ = monitor_call_ = false;
    const std::uint32_t thumb = (reg(UC_ARM_REG_CPSR) & kThumb) != 0 ? 1U : 0U;
    unicorn_->stores->begin();
    const uc_err error = uc_emu_start(unicorn_->engine, pc_ | thumb, kNowhere, 0, 0);
    unicorn_->stores->end();
    pc_ = reg(UC_ARM_REG_PC);
    if (error != UC_ERR_OK && paused_ != Pause::kCrashed) {
      fail(error == UC_ERR_INSN_INVALID ? CrashKind::kUndefinedInstruction : CrashKind::kEmulator,
           static_cast<std::uint32_t>(error), pc_);
    }
    if (paused_ == Pause::kCrashed) {
      return Pause::kCrashed;
    }
    if (supervisor_call_) {
      enter(kModeSupervisor, kSupervisorVector, supervisor_return_);
      continue;
    }
    if (monitor_call_) {
      continue;
    }
    if (paused_ == Pause::kAgain) {
      forget_code(block_, block_size_);
      continue;
    }
    // Unicorn leaves by itself at WFI only.
    return paused_.value_or(Pause::kWaiting);
  }
}

void Processor::enter(std::uint32_t mode, std::uint32_t vector, std::uint32_t return_address) {
  uc_arm_cp_reg base{};
  base.cp = 15;
  base.crn = 12;
  uc_reg_read(unicorn_->engine, UC_ARM_REG_CP_REG, &base);
  const std::uint32_t status = reg(UC_ARM_REG_CPSR);
  set_reg(UC_ARM_REG_CPSR, (status & ~(kModeMask | kThumb | kIfThenState)) | mode | kInterruptsOff);
  set_reg(UC_ARM_REG_LR, return_address);
  set_reg(UC_ARM_REG_SPSR, status);
  pc_ = static_cast<std::uint32_t>(base.val) + vector;
}

void Processor::take_interrupt() {
  interrupts_.accept();
  idle_.restart();
  profile_.enter(interrupts_.number(), pc_, stack_pointer(), bus_.now_ns);
  enter(kModeInterrupt, kInterruptVector, pc_ + 4);
}

}  // namespace towbench::board
