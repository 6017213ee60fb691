// ExternalBench by the wall clock.
#include <algorithm>

#include <fmt/format.h>

#include "harness/external/external_bench.h"
#include "harness/realtime/realtime_plant.h"

namespace towbench::harness {

RunOutcome ExternalBench::run_by_the_wall_clock(const protocol::Hello& hello, TickLoop& loop,
                                                AnswerWatch& answers,
                                                const LoopWatchers& watchers) {
  const auto start = HostClock::now();
  if (hello.exchange_ns == 0 || hello.exchange_ns % core::kPlantTick_ns != 0) {
    outcome_.reason = fmt::format(
        "an exchange of {} ns: by the wall clock it is a whole number of "
        "the plant's ticks of 100 us",
        hello.exchange_ns);
    return ended(start);
  }
  answers_ = &answers;
  plant_.node.connect(thinner_.emplace(to_controller_, hello.exchange_ns));
  if (greet(hello)) {
    tick_until_over(loop, answers, watchers);
    loop.end_tick();
  }
  return ended(start);
}

void ExternalBench::tick_until_over(TickLoop& loop, AnswerWatch& answers,
                                    const LoopWatchers& watchers) {
  loop.start();
  while (!ended_) {
    loop.wait();
    if (!hear_tick(answers)) {
      return;
    }
    const auto now_ns = plant_.node.now_ns();
    answers.tick(now_ns, std::any_of(commands_.begin(), commands_.end(),
                                     [](const AxisCommand& axis) { return axis.duty != 0; }));
    if (now_ns % outcome_.exchange_ns == 0) {
      if (said_too_much()) {
        return;
      }
      end_exchange();
      interrupt_if_asked(watchers);
      if (ended_) {
        break;
      }
      if (operator_ != nullptr) {
        take_operator_acts(now_ns);
      }
      record_.recorder.row(take_row(now_ns));
    }
    until_ns_ = now_ns + core::kPlantTick_ns;
    plant_.node.on(protocol::Advance{until_ns_});
  }
  loop.end_tick();  // what follows is no part of the loop
  (void)link_.wait(to_plant_);
}

bool ExternalBench::hear_tick(AnswerWatch& answers) {
  const auto heard = link_.listen(to_plant_, 0);
  auto lost = heard ? core::ErrorCode::kNone : heard.error();
  if (answers.silent_ns(plant_.node.now_ns()) > kRealtimeSilence_ns) {
    lost = core::ErrorCode::kPeerSilent;
  }
  if (lost != core::ErrorCode::kNone || plant_.node.finished()) {
    lose(lost, lost == core::ErrorCode::kNone
                   ? ""
                   : fmt::format(": {} ({})", core::describe(lost), core::number_of(lost)));
    return false;
  }
  return true;
}

}  // namespace towbench::harness
