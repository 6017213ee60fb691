// BBMC on bare metal: the three layers on the registers of an AM335x.
//
// The pace timer's interrupt serves the control path once an exchange; the console runs in the loop
// of main(), with that interrupt held back while it does, so that a request never meets a
// half-served exchange. The lines' interrupts come between at any time, the kill switch first.
#include <cstdint>
#include <span>

#include "bbmc/application/application.h"
#include "bbmc/baremetal/am335x.h"
#include "bbmc/baremetal/debug_port.h"
#include "bbmc/baremetal/line_edges.h"
#include "bbmc/baremetal/parameter_block.h"
#include "bbmc/baremetal/register_ports.h"
#include "bbmc/system/system_manager.h"
#include "core/check.h"

using namespace towbench;
using namespace towbench::bbmc;
using am335x::word;

// Names that a programmer, a debugger or the start-up code looks for.
extern "C" {
extern std::uint32_t bbmc_vectors[];
ParameterBlock bbmc_parameters{.count = 0};
DebugPort bbmc_debug_port;
void bbmc_interrupt();
void bbmc_halt();
}

namespace {

[[gnu::section(".log,\"aw\",%nobits@")]] alignas(
    64) std::byte log_bytes[kDataLogRows * sizeof(DataLogRow)];

constexpr std::uint32_t kLevels[] = {am335x::kUrgentLinesInterrupt, am335x::kOtherLinesInterrupt,
                                     am335x::kPaceInterrupt};

Configuration configuration() noexcept {
  Configuration read;
  core::check(unpack(bbmc_parameters, read));
  core::check(inconsistency(read) == nullptr);
  return read;
}

struct Board {
  LineEdges edges;
  PaceClock clock;
  PerAxis<RegisterPwm> pwm;
  PerAxis<RegisterEqep> encoder;
  RegisterTimer timer{clock};
  std::array<RegisterLine, kLineCount> lines;
  RegisterUart console;
  RegisterInterrupts interrupts{edges};

  Board() noexcept {
    for (const core::Axis axis : kAxes) {
      pwm[axis].attach(axis, edges);
      encoder[axis].attach(axis, clock);
    }
    for (std::size_t i = 0; i < kLineCount; ++i) {
      lines[i].attach(static_cast<Line>(i));
    }
  }

  [[nodiscard]] BoardPorts ports() noexcept {
    BoardPorts all;
    for (const core::Axis axis : kAxes) {
      all.pwm[axis] = &pwm[axis];
      all.encoder[axis] = &encoder[axis];
    }
    all.control_timer = &timer;
    for (std::size_t i = 0; i < kLineCount; ++i) {
      all.lines[i] = &lines[i];
    }
    all.console = &console;
    all.interrupts = &interrupts;
    return all;
  }
};

std::span<DataLogRow> log_storage() noexcept {
  return {reinterpret_cast<DataLogRow*>(log_bytes), kDataLogRows};
}

struct Controller {
  Board board;
  DeviceManager devices{board.ports()};
  SystemManager system{configuration(), devices, log_storage()};
  Application application{system, devices};
  volatile std::uint32_t services = 0;
};

Controller& controller() noexcept {
  static Controller the_one;
  return the_one;
}
Controller* running = nullptr;

void enable_clocks() noexcept {
  for (const std::uint32_t module : am335x::kModuleClocks) {
    word(module) = am335x::kModuleEnabled;
    while ((word(module) & 3U << 16U) != 0) {
    }
  }
}

void enable_interrupts() noexcept {
  for (std::uint32_t priority = 0; priority < 3; ++priority) {
    const std::uint32_t n = kLevels[priority];
    word(am335x::line_register(n)) = priority << 2U;
    word(am335x::mask_clear(n)) = 1U << (n % 32);
  }
  asm volatile("cpsie i" : : : "memory");
}

// The control path waits while the console runs.
class PaceHeldBack {
 public:
  PaceHeldBack() noexcept {
    word(am335x::mask_set(am335x::kPaceInterrupt)) = 1U << (am335x::kPaceInterrupt % 32);
    asm volatile("dsb" : : : "memory");
  }
  PaceHeldBack(const PaceHeldBack&) = delete;
  PaceHeldBack& operator=(const PaceHeldBack&) = delete;
  ~PaceHeldBack() {
    word(am335x::mask_clear(am335x::kPaceInterrupt)) = 1U << (am335x::kPaceInterrupt % 32);
  }
};

void publish(Controller& self) noexcept {
  DebugPort& port = bbmc_debug_port;
  TelemetryRow row;
  while (self.system.next_row(row)) {
    port.lost += port.rows.push(row) ? 0U : 1U;
  }
  SystemEvent event;
  while (self.system.next_event(event)) {
    port.lost += port.events.push(event) ? 0U : 1U;
  }
  port.idle = self.system.at_rest() && self.application.idle() && self.board.console.all_fed() &&
                      !RegisterUart::has_input()
                  ? 1U
                  : 0U;
}

void serve_pace(Controller& self) noexcept {
  constexpr std::uint32_t kOverflow = 2;
  word(am335x::kPaceTimer + am335x::kTimerStatus) = kOverflow;
  for (std::uint32_t begun = self.board.clock.begun(); begun > 0; --begun) {
    self.board.clock.tick();
    self.system.service(self.board.clock.service_ns());
    self.services = self.services + 1;
    if (begun > 1) {
      bbmc_debug_port.late_services = bbmc_debug_port.late_services + 1;
    }
  }
}

[[noreturn]] void serve_console(Controller& self) noexcept {
  std::uint32_t served = 0;  // the first exchange may be over already
  while (true) {
    // Woken by any interrupt; an exchange that ended since the last look is not slept through.
    asm volatile("cpsid i" : : : "memory");
    if (served == self.services) {
      asm volatile("wfi" : : : "memory");
    }
    asm volatile("cpsie i\n isb" : : : "memory");
    if (served == self.services) {
      continue;
    }
    served = self.services;
    const PaceHeldBack held;
    self.application.poll(self.board.clock.service_ns());
    self.board.console.feed();
    publish(self);
  }
}

}  // namespace

// Nested by priority, as AINTC's threshold allows: while one is served only more urgent ones come.
void bbmc_interrupt() {
  const std::uint32_t number = word(am335x::kAintcNumber) & 0x7FU;
  const std::uint32_t priority = word(am335x::kAintcPriority) & 0x3FU;
  const std::uint32_t threshold = word(am335x::kAintcThreshold);
  word(am335x::kAintcThreshold) = priority;
  word(am335x::kAintcControl) = 1;  // NEWIRQAGR
  asm volatile("dsb" : : : "memory");
  Controller& self = *running;
  if (number == am335x::kUrgentLinesInterrupt) {
    self.board.edges.take_urgent(self.board.clock.now_ns());
  } else {
    asm volatile("cpsie i" : : : "memory");
    if (number == am335x::kPaceInterrupt) {
      serve_pace(self);
    } else {
      self.board.edges.take_others(self.board.clock.now_ns());
    }
    asm volatile("cpsid i" : : : "memory");
  }
  word(am335x::kAintcThreshold) = threshold;
}

void bbmc_halt() {
  for (const core::Axis axis : kAxes) {
    am335x::half(am335x::pwm(axis) + 0x30) = 1U << 2U;  // TZFRC: both pins low
  }
}

int main() {
  enable_clocks();
  bbmc_debug_port.magic = DebugPort::kMagic;
  Controller& self = controller();
  running = &self;
  word(am335x::kPwmTimeBases) = 0x7;
  core::check(self.system.start().has_value());
  enable_interrupts();
  serve_console(self);
}

// What crti.o, which is not linked, would give newlib's start of the constructors.
void* __dso_handle = nullptr;
extern "C" {
void _init() {}
void _fini() {}
}

// newlib's abort() ends here: a broken invariant takes the drive off and stays where it is.
extern "C" [[noreturn]] void _exit(int /*status*/) {
  asm volatile("cpsid i" : : : "memory");
  bbmc_halt();
  while (true) {
  }
}
extern "C" int _kill(int /*process*/, int /*signal*/) {
  return -1;
}
extern "C" int _getpid() {
  return 1;
}
