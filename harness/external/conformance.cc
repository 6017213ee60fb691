#include "harness/external/conformance.h"

#include <array>
#include <chrono>
#include <functional>
#include <thread>

#include <fmt/format.h>

#include "core/random.h"
#include "harness/external/conform_session.h"
#include "protocol/frame.h"

namespace towbench::harness {
namespace {

constexpr double kUnderWay_s = 0.5;

// What came of it.
struct Finding {
  Verdict verdict = Verdict::kPass;
  std::string reason;
};
Finding kept() {
  return {};
}
Finding broken(std::string reason) {
  return {Verdict::kFail, std::move(reason)};
}
Finding shows_nothing(std::string reason) {
  return {Verdict::kInvalid, std::move(reason)};
}

void pause(double host_s) {
  std::this_thread::sleep_for(std::chrono::duration<double>(host_s));
}

// Under way and driving; else why not.
std::string reach_motion(ConformSession& session) {
  auto why = session.greet();
  if (why.empty() && !session.run_to(kUnderWay_s)) {
    why = fmt::format("the controller left at {:.3f} s", session.now_s());
  }
  if (why.empty() && !session.drives()) {
    why = "the controller drives nothing, half a second after its reference began to move";
  }
  return why;
}

// Either it goes on in step, or it leaves in order: after something that is not its fault, but not
// to be trusted either.
Finding goes_on_or_stops(ConformSession& session, bool may_stop) {
  const double until_s = session.now_s() + 0.1;
  if (session.run_to(until_s)) {
    return session.odd_turns() == 0 ? kept() : broken("it asks for other times than before");
  }
  if (!may_stop) {
    return broken(fmt::format("it left at {:.3f} s", session.now_s()));
  }
  const auto how = session.ended();
  const bool crashed = how && how->find("signal") != std::string::npos;
  return crashed ? broken("it " + *how) : kept();
}

// Within ten turns, and what was on its way.
bool gives_up_drive(ConformSession& session) {
  for (int turns = 0; turns < 12; ++turns) {
    if (!session.turn() || session.complained() || !session.drives()) {
      return true;
    }
  }
  return false;
}

// A frame of a message that was changed behind the encoder's back.
std::vector<std::byte> changed_frame(std::size_t at, std::byte value) {
  std::array<std::byte, protocol::LengthFraming::kMaxFrameSize> frame{};
  const auto size = protocol::LengthFraming::append(protocol::DigitalInputs{}, frame);
  frame[protocol::kFrameHeaderSize + at] = value;
  const auto covered = size - protocol::kCrcSize;
  protocol::store_little_endian(frame.data() + covered,
                                protocol::crc32c(std::span(frame).first(covered)));
  return {frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(size)};
}

// ---- the duties ----

Finding greets(ConformSession& session) {
  const auto why = session.greet();
  if (!why.empty()) {
    return shows_nothing(why);
  }
  return session.refusal() == core::ErrorCode::kNone
             ? kept()
             : broken(fmt::format("refused: {}", core::describe(session.refusal())));
}

Finding begins_undriven(ConformSession& session) {
  const auto why = session.greet();
  if (!why.empty()) {
    return shows_nothing(why);
  }
  while (session.now_s() < 0.05) {
    if (!session.turn()) {
      return broken(fmt::format("it left at {:.3f} s", session.now_s()));
    }
    if (session.drives()) {
      return broken(fmt::format("it drives at {:.3f} s, its reference stands", session.now_s()));
    }
  }
  return kept();
}

Finding keeps_turns(ConformSession& session) {
  const auto why = reach_motion(session);
  if (!why.empty()) {
    return shows_nothing(why);
  }
  if (session.odd_turns() > 0) {
    return broken(
        fmt::format("{} turns ask for another time than one exchange later", session.odd_turns()));
  }
  return session.refused() == 0
             ? kept()
             : broken(fmt::format("{} messages were refused", session.refused()));
}

Finding accepts_refusal(ConformSession& session) {
  const auto why = session.greet(core::ErrorCode::kProtocolVersion);
  if (!why.empty()) {
    return shows_nothing(why);
  }
  (void)session.turn();
  if (session.heard() > 0 && !session.complained()) {
    return broken("it goes on after it was refused");
  }
  return session.ended() ? kept() : broken("it is still there two seconds after it was refused");
}

Finding notices_loss(ConformSession& session) {
  if (const auto why = reach_motion(session); !why.empty()) {
    return shows_nothing(why);
  }
  session.lose_a_count();
  return gives_up_drive(session) ? kept()
                                 : broken("a count was lost, and ten turns later it drives on");
}

Finding misses_absolute(ConformSession& session) {
  if (const auto why = reach_motion(session); !why.empty()) {
    return shows_nothing(why);
  }
  if (!session.wants_absolute_counts()) {
    return kept();
  }
  session.lose_absolute_counts();
  return gives_up_drive(session)
             ? kept()
             : broken("its absolute counts have stopped, and ten turns later it drives on");
}

Finding ignores_unknown(ConformSession& session) {
  if (const auto why = reach_motion(session); !why.empty()) {
    return shows_nothing(why);
  }
  session.send_raw(changed_frame(0, std::byte{200}));
  return goes_on_or_stops(session, false);
}

Finding drops_illegal_field(ConformSession& session) {
  if (const auto why = reach_motion(session); !why.empty()) {
    return shows_nothing(why);
  }
  session.send_raw(changed_frame(2, std::byte{0xff}));  // lines that there are not
  return goes_on_or_stops(session, true);
}

Finding survives_garbage(ConformSession& session) {
  if (const auto why = reach_motion(session); !why.empty()) {
    return shows_nothing(why);
  }
  core::Random random(1);
  std::array<std::byte, 64> garbage{};
  for (auto& byte : garbage) {
    byte = static_cast<std::byte>(random.bits() & 0xffU);
  }
  session.send_raw(garbage);
  return goes_on_or_stops(session, true);
}

Finding waits_for_late_turn(ConformSession& session) {
  if (const auto why = reach_motion(session); !why.empty()) {
    return shows_nothing(why);
  }
  pause(0.5);
  return goes_on_or_stops(session, false);
}

Finding stops_when_silent(ConformSession& session) {
  if (const auto why = reach_motion(session); !why.empty()) {
    return shows_nothing(why);
  }
  pause(2.5);
  // The turn that was under way, then what it says after the silence.
  if (!session.turn() || !session.turn() || session.complained() || !session.drives()) {
    return kept();
  }
  return broken("the bench was silent for 2.5 s, and it drives on");
}

Finding ends_when_bench_dies(ConformSession& session) {
  if (const auto why = reach_motion(session); !why.empty()) {
    return shows_nothing(why);
  }
  session.hang_up();
  const auto how = session.ended();
  if (!how) {
    return broken("it is still there two seconds after the bench has gone");
  }
  return how->find("signal") == std::string::npos ? kept() : broken("it " + *how);
}

Finding ends_after_bye(ConformSession& session) {
  if (const auto why = reach_motion(session); !why.empty()) {
    return shows_nothing(why);
  }
  session.say_bye();
  const auto how = session.ended();
  if (!how) {
    return broken("it is still there two seconds after Bye");
  }
  return how->empty() ? kept() : broken("it " + *how);
}

Finding obeys_kill(ConformSession& session) {
  if (const auto why = reach_motion(session); !why.empty()) {
    return shows_nothing(why);
  }
  session.press_kill_switch();
  (void)session.turn();
  (void)session.turn();
  return session.drives() ? broken("two turns after the kill switch it drives on") : kept();
}

struct Duty {
  const char* name;
  const char* meaning;
  const char* requirement;
  Finding (*check)(ConformSession&);
  bool (*applies)(const emulator::RigParameters&) = nullptr;  // null: to every machine

  [[nodiscard]] bool applies_to(const emulator::RigParameters& rig) const {
    return applies == nullptr || applies(rig);
  }
};
constexpr std::array<Duty, 14> kDuties{{
    {"greets", "its Hello can be agreed to", "CON-1", greets},
    {"begins_undriven", "a start, or a restart, begins with zero duty", "CON-2", begins_undriven},
    {"keeps_turns", "each turn asks for one exchange, and all it sends is legal", "CON-3",
     keeps_turns},
    {"accepts_refusal", "refused, it sends nothing more and ends", "CON-4", accepts_refusal},
    {"notices_loss", "a gap in the sequence ends the drive", "CON-5", notices_loss},
    {"ignores_unknown", "a message of an unknown kind changes nothing", "CON-6", ignores_unknown},
    {"drops_illegal_field", "a message with an illegal field ends in no crash", "CON-7",
     drops_illegal_field},
    {"survives_garbage", "bytes that are no frame end in no crash", "CON-8", survives_garbage},
    {"waits_for_late_turn", "an answer after half a second is in time", "CON-9",
     waits_for_late_turn},
    {"stops_when_silent", "a bench that is silent for 2.5 s is not driven on", "CON-10",
     stops_when_silent},
    {"ends_when_bench_dies", "it ends within 2 s when the bench is gone", "CON-11",
     ends_when_bench_dies},
    {"ends_after_bye", "after Bye it ends within 2 s, with code 0", "CON-12", ends_after_bye},
    {"obeys_kill", "the turn after the kill switch's edge drives nothing", "CON-13", obeys_kill},
    {"misses_absolute", "absolute counts that it asked for and that stop end the drive", "CON-14",
     misses_absolute, emulator::tells_counts},
}};

}  // namespace

std::vector<std::string> conformance_duties() {
  std::vector<std::string> names;
  for (const auto& duty : kDuties) {
    names.emplace_back(duty.name);
  }
  return names;
}

std::vector<std::string> conformance_duties(const emulator::RigParameters& rig) {
  std::vector<std::string> names;
  for (const auto& duty : kDuties) {
    if (duty.applies_to(rig)) {
      names.emplace_back(duty.name);
    }
  }
  return names;
}

std::vector<Check> check_conformance(const std::string& command, const emulator::RigParameters& rig,
                                     const std::filesystem::path& printed,
                                     const std::string& only) {
  std::vector<Check> checks;
  for (const auto& duty : kDuties) {
    if (!duty.applies_to(rig) || (!only.empty() && only != duty.name)) {
      continue;
    }
    ConformSession session(command, rig, printed);
    const auto found = duty.check(session);
    Check check;
    check.name = duty.name;
    check.meaning = duty.meaning;
    check.source = duty.requirement;
    check.verdict = found.verdict;
    check.reason = found.reason;
    checks.push_back(std::move(check));
  }
  return checks;
}

}  // namespace towbench::harness
