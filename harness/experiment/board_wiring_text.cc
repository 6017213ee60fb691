#include "harness/experiment/board_wiring_text.h"

#include <array>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "harness/fixtures/table_reader.h"

namespace towbench::harness {
namespace {

constexpr unsigned kBanks = 4;
constexpr unsigned kPins = 32;

// "gpio1.16", "!gpio1.16" where low is active.
std::optional<BoardPin> pin_named(const std::string& text) {
  BoardPin pin;
  pin.active_low = text.starts_with('!');
  char end = 0;
  const char* const place = text.c_str() + (pin.active_low ? 1 : 0);
  const bool read = std::sscanf(place, "gpio%1u.%2u%c", &pin.bank, &pin.pin, &end) == 2;
  return read && pin.bank < kBanks && pin.pin < kPins ? std::optional(pin) : std::nullopt;
}

// Every pin that is wired, by its key.
using Used = std::vector<std::pair<std::string, BoardPin>>;

void read_pin(TableReader& reader, const char* key, const char* meaning,
              std::optional<BoardPin>& pin) {
  if (!reader.has(key)) {
    reader.permit(key);
    return;
  }
  std::string text;
  reader.text(key, text, meaning);
  pin = text == "none" ? std::nullopt : pin_named(text);
  if (!pin && text != "none") {
    throw FixtureError(reader.place_of(key), '"' + text + '"',
                       "gpioB.P with B 0 to 3 and P 0 to 31, with ! before it where low is "
                       "active; or none");
  }
}

struct PinKey {
  const char* key;
  const char* meaning;
  std::optional<BoardPin> AxisWiring::*pin;
};
constexpr std::array<PinKey, 6> kPinKeys{{
    {"direction", "output: its level gives the sign", &AxisWiring::direction},
    {"hall", "end-stops of both ends", &AxisWiring::hall},
    {"hall_min", "end-stop towards min", &AxisWiring::hall_min},
    {"hall_max", "end-stop towards max", &AxisWiring::hall_max},
    {"ready", "the amplifier is ready", &AxisWiring::ready},
    {"enable", "output: the amplifier drives", &AxisWiring::enable},
}};

void read_axis_wiring(TableReader& reader, AxisWiring& wiring) {
  std::size_t encoder = wiring.encoder;
  std::size_t pwm = wiring.pwm;
  std::size_t channels = 0;
  reader.choice("encoder", encoder, {"eqep0", "eqep1", "eqep2"});
  reader.choice("pwm", pwm, {"ehrpwm0", "ehrpwm1", "ehrpwm2"});
  reader.choice("channels", channels, {"a_towards_max", "b_towards_max"});
  wiring.encoder = static_cast<unsigned>(encoder);
  wiring.pwm = static_cast<unsigned>(pwm);
  wiring.channels_swapped = channels == 1;
  for (const auto& each : kPinKeys) {
    read_pin(reader, each.key, each.meaning, wiring.*each.pin);
  }
  reader.finish();
}

Used used_by(const BoardWiring& wiring) {
  Used used;
  for (const auto axis : core::kPlanarAxes) {
    for (const auto& each : kPinKeys) {
      if (const auto& pin = wiring.axes[axis].*each.pin) {
        used.emplace_back(fmt::format("axis.{}.{}", core::name_of(axis), each.key), *pin);
      }
    }
  }
  if (wiring.kill_switch) {
    used.emplace_back("kill_switch", *wiring.kill_switch);
  }
  return used;
}

void refuse_double_use(const FixtureFile& file, const BoardWiring& wiring) {
  const auto used = used_by(wiring);
  for (std::size_t i = 0; i < used.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (used[i].second.same_place(used[k].second)) {
        throw FixtureError({file.path().string(), 0, used[i].first},
                           fmt::format("gpio{}.{}, which {} has", used[i].second.bank,
                                       used[i].second.pin, used[k].first),
                           "a pin of its own; none where it is not wired");
      }
    }
  }
  const auto& y = wiring.axes[core::Axis::kY];
  const auto& x = wiring.axes[core::Axis::kX];
  if (y.encoder == x.encoder || y.pwm == x.pwm) {
    throw FixtureError({file.path().string(), 0, y.pwm == x.pwm ? "axis.x.pwm" : "axis.x.encoder"},
                       "what axis.y has", "a module of its own for each axis");
  }
}

}  // namespace

BoardWiring read_board_wiring(const FixtureFile& file) {
  BoardWiring wiring;
  TableReader reader(file, file.table());
  std::string name;
  std::string title;
  std::size_t console = 0;
  reader.text("name", name, "short name");
  reader.text("title", title, "one line for a person");
  reader.choice("console", console, {"uart0"});
  read_pin(reader, "kill_switch", "the kill switch", wiring.kill_switch);
  if (auto axes = reader.subtable("axis")) {
    for (const auto which : core::kPlanarAxes) {
      if (auto axis = axes->subtable(core::name_of(which))) {
        read_axis_wiring(*axis, wiring.axes[which]);
      }
    }
    axes->finish();
  }
  reader.finish();
  refuse_double_use(file, wiring);
  return wiring;
}

}  // namespace towbench::harness
