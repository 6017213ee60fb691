// Any bytes typed at the console of a small machine, in any portions, into a UART of any room.
//
// Whatever is typed: the program lives, the terminal is sent nothing but text and the few controls
// of the line editor, gains stay finite, and no drive is on unless a motion runs.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "tests/bbmc/application/support/session.h"

namespace {

using towbench::bbmc::PidGains;
using towbench::bbmc::testing::Session;

void require(bool property) {
  if (!property) {
    std::abort();
  }
}

bool may_be_sent(char c) {
  return (c >= ' ' && c <= '~') || c == '\r' || c == '\n' || c == '\a' || c == '\b' || c == '\x1b';
}

void check(Session& session) {
  for (const char c : session.heard()) {
    require(may_be_sent(c));
  }
  for (const towbench::core::Axis axis : towbench::core::kPlanarAxes) {
    const PidGains& gains = session.system().configuration().axes[axis].gains;
    require(std::isfinite(gains.proportional_Nm_per_rad) && gains.proportional_Nm_per_rad >= 0);
    require(std::isfinite(gains.integral_Nm_per_rad_s) && gains.integral_Nm_per_rad_s >= 0);
    require(std::isfinite(gains.derivative_Nm_s_per_rad) && gains.derivative_Nm_s_per_rad >= 0);
    require(!session.system().at_rest() || session.machine().duty_ratio(axis) == 0);
    require(std::isfinite(session.status().axes[axis].position_m));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) {
    return 0;
  }
  Session session(200);
  const std::uint8_t mode = data[0];
  if ((mode & 1U) != 0) {
    session.calibrate();
  }
  session.machine().uart_room = (mode & 2U) != 0 ? 64 : 1'000'000;
  const std::size_t portion = 1 + (mode >> 2U);
  std::string_view typed(reinterpret_cast<const char*>(data) + 1, size - 1);
  while (!typed.empty()) {
    session.machine().to_controller += typed.substr(0, portion);
    typed.remove_prefix(typed.size() < portion ? typed.size() : portion);
    session.run(0.002);
    check(session);
  }
  for (int i = 0; i < 50; ++i) {
    session.run(0.002);
    check(session);
  }
  return 0;
}
